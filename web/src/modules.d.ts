/** bindings/wasm/poise.mjs */
declare module '@core' {
  export function load(wasm: ArrayBuffer): Promise<(request: string) => string>;
}

/** Its WebAssembly: so many bytes, packed by LZMA, as base64. */
declare module 'virtual:core' {
  export const size: number;
  export const text: string;
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
