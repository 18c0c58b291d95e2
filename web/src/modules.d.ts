/** bindings/wasm/poise.mjs */
declare module '@core' {
  export function load(wasm: ArrayBuffer): Promise<(request: string) => string>;
}

declare module '@lzma/streams.js' {
  export class InputBuffer {
    constructor(bytes: Uint8Array);
  }
  export class OutputBuffer {
    constructor(size: number);
    toArray(): Uint8Array;
  }
}
declare module '@lzma/decoder.js' {
  import type { InputBuffer, OutputBuffer } from '@lzma/streams.js';
  export class Decoder {
    decompress(from: InputBuffer, to: OutputBuffer): void;
  }
}

/** Its WebAssembly, LZMA as base64. */
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
