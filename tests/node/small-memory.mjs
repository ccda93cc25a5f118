// The decoder's WebAssembly with less memory than it may need.

/** A copy of the module whose memory cannot grow beyond a number of pages of 64 kB. */
export function withMemory(wasm, pages) {
  const bytes = new Uint8Array(wasm);
  let at = 8; // after magic and version
  const readNumber = () => {
    let value = 0;
    for (let shift = 0; ; shift += 7) {
      const byte = bytes[at++];
      value += (byte & 0x7f) * 2 ** shift;
      if (byte < 0x80) return value;
    }
  };
  while (at < bytes.length) {
    const section = bytes[at++];
    const length = readNumber();
    if (section !== 5) {
      at += length;
      continue;
    }
    if (readNumber() !== 1 || bytes[at++] !== 1) throw new Error('not one memory with a maximum');
    readNumber(); // its first size
    const start = at;
    readNumber(); // its maximum
    const width = at - start;
    for (let i = 0, rest = pages; i < width; i++, rest >>= 7)
      bytes[start + i] = (rest & 0x7f) | (i < width - 1 ? 0x80 : 0);
    return bytes;
  }
  throw new Error('no memory');
}
