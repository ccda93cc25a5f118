// Each edge once: the two triangles at an edge of a closed surface list it in opposite directions.
self.onmessage = ({
  data: { id, indices },
}: MessageEvent<{ id: number; indices: Uint32Array }>) => {
  const edges = new Uint32Array(2 * indices.length);
  let length = 0;
  const add = (from: number, to: number) => {
    if (from > to) return;
    edges[length++] = from;
    edges[length++] = to;
  };
  for (let i = 0; i < indices.length; i += 3) {
    add(indices[i]!, indices[i + 1]!);
    add(indices[i + 1]!, indices[i + 2]!);
    add(indices[i + 2]!, indices[i]!);
  }
  const exact = edges.slice(0, length);
  self.postMessage({ id, edges: exact }, { transfer: [exact.buffer] });
};
