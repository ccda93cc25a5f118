// Run by misuse.test.mjs in a process of its own: drops iterators without return(), and prints how
// much memory the process has after some and after all of them.
import { readFileSync } from 'node:fs';
import { createDecoder } from 'isostar';

const [path, count] = process.argv.slice(2);
const bytes = new Uint8Array(readFileSync(path));
const decoder = await createDecoder();

/** Takes one surface; then nothing refers to the iterator. */
async function drop() {
  const { value } = await decoder.decode(bytes).next();
  if (value.indices.length === 0) throw new Error('no surface');
}
async function dropMany(count) {
  for (let i = 0; i < count; i++) {
    await drop();
    if (i % 10 !== 9) continue;
    globalThis.gc?.(); // with --expose-gc
    await new Promise((resolve) => setTimeout(resolve)); // finalizers run
  }
  return process.memoryUsage().rss;
}

const some = await dropMany(40);
const all = await dropMany(Number(count) - 40);
let last;
for await (const surface of decoder.decode(bytes)) last = surface;
console.log(JSON.stringify({ some, all, isFinal: last.final }));
