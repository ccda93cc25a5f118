/** The results of work(input), in the order of the inputs; `count` of them run at the same time. */
export async function inParallel(count, inputs, work) {
  const waiting = [...inputs.entries()];
  const results = [];
  const worker = async () => {
    for (let next; (next = waiting.shift());) {
      const [index, input] = next;
      results[index] = await work(input);
    }
  };
  await Promise.all(Array.from({ length: count }, worker));
  return results;
}
