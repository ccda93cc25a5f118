/** What work(input) gives for each input, in their order; some are worked on side by side. */
export async function atOnce(count, inputs, work) {
  const waiting = inputs.map((input, place) => ({ input, place }));
  const results = [];
  const worker = async () => {
    for (let next; (next = waiting.shift());) results[next.place] = await work(next.input);
  };
  await Promise.all(Array.from({ length: count }, worker));
  return results;
}
