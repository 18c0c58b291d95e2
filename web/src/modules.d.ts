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

/** A grasp file of examples/, as JSON; if its shape is a mesh, with that. */
declare module '@examples/*.mesh.json' {
  const example: { grasp: import('./grasp').SpatialGrasp; mesh: import('./fold').Folded };
  export default example;
}
declare module '@examples/*.grasp.json' {
  const grasp: import('./grasp').Grasp;
  export default grasp;
}
