/** The WebAssembly core as emscripten writes it. */
declare module '@core' {
  export interface Core {
    HEAPU8: Uint8Array<ArrayBuffer>;
    _malloc(size: number): number;
    _free(at: number): void;
    /** JSON in, JSON out: texts that end with a 0. */
    _poise_answer(request: number): number;
  }
  export default function create(options: { wasmBinary: ArrayBuffer }): Promise<Core>;
}

/** Its WebAssembly, zstd as base64. */
declare module 'virtual:core' {
  const text: string;
  export default text;
}

/** A script as a worker, within the page. */
declare module '*?worker&inline' {
  const Inlined: new () => Worker;
  export default Inlined;
}

/** A grasp file of examples/, as JSON. */
declare module '@examples/*' {
  const grasp: import('./grasp').Grasp;
  export default grasp;
}
