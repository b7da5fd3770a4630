// The functions of eem.wasm, with texts and arrays instead of addresses. For the worker, and for tests without a browser.

/** Instantiates the module. */
export async function load(bytes) {
  const { instance } = await WebAssembly.instantiate(bytes, {});
  const call = instance.exports;
  const sampleSize = call.eem_sample_size();

  const write = (text) => {
    const utf8 = new TextEncoder().encode(text);
    // Before the memory is looked at: it may move.
    const room = call.eem_room(utf8.length);
    new Uint8Array(call.memory.buffer, room, utf8.length).set(utf8);
  };
  const answer = () => {
    const [start, length] = [call.eem_text(), call.eem_text_length()];
    return JSON.parse(new TextDecoder().decode(new Uint8Array(call.memory.buffer, start, length)));
  };
  const samples = () => {
    const [start, length] = [call.eem_samples(), call.eem_samples_length()];
    return new Float64Array(call.memory.buffer, start, length).slice();
  };

  return {
    /** Bytes of memory that the module has. */
    memoryBytes: () => call.memory.buffer.byteLength,
    /** Examples, schemes, and how many numbers a sample has. */
    contents() {
      call.eem_contents();
      return { ...answer(), sampleSize };
    },
    /** What a sheet means: its law, and all that is wrong with it. */
    read(sheet) {
      write(sheet);
      call.eem_read();
      return answer();
    },
    /** Starts a run for each scheme: why it does not, if so, and its first sample. */
    start(setting, schemes) {
      write(JSON.stringify({ setting, schemes }));
      call.eem_start();
      const all = samples();
      let next = 0;
      return answer().map((standing) =>
        standing.failure === null
          ? { ...standing, samples: all.slice(next, (next += sampleSize)) }
          : { ...standing, samples: new Float64Array() });
    },
    /** Makes steps with a run, until one fails. */
    advance(run, steps) {
      call.eem_advance(run, steps);
      return { ...answer(), samples: samples() };
    },
  };
}
