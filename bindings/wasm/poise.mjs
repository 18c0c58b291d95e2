// The core as WebAssembly: its one function, and the little that it asks of a system.

/** Takes the bytes of poise.wasm; gives the function of answer.hpp, JSON in, JSON out. */
export async function load(bytes) {
  const module = await WebAssembly.compile(bytes);
  const system = {
    environ_sizes_get(count, size) {
      const memory = new DataView(core.memory.buffer);
      memory.setUint32(count, 0, true);
      memory.setUint32(size, 0, true);
      return 0;
    },
    environ_get: () => 0,
    emscripten_notify_memory_growth() {},
  };
  const imports = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module))
    (imports[from] ??= {})[name] = system[name] ?? (() => {
      throw new Error(`poise.wasm asks for ${name}`);
    });
  const { exports: core } = await WebAssembly.instantiate(module, imports);
  core._initialize();

  return (request) => {
    const text = new TextEncoder().encode(`${request}\0`);
    const at = core.malloc(text.length);
    new Uint8Array(core.memory.buffer).set(text, at);
    const answer = core.poise_answer(at);
    core.free(at);
    const memory = new Uint8Array(core.memory.buffer);
    return new TextDecoder().decode(memory.subarray(answer, memory.indexOf(0, answer)));
  };
}
