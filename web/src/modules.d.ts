/** bindings/wasm/poise.mjs */
declare module '@core' {
  export function load(wasm: ArrayBuffer): Promise<(request: string) => string>;
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
