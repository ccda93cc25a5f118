const SLICE_SECONDS = 0.02;

/** Passes bytes on at the rate of a slower link. */
export function throttle(bitsPerSecond: number): TransformStream<Uint8Array, Uint8Array> {
  const bytesPerSecond = bitsPerSecond / 8;
  const slice = Math.max(1, Math.round(bytesPerSecond * SLICE_SECONDS));
  const start = performance.now();
  let passed = 0;
  return new TransformStream({
    async transform(piece, controller) {
      for (let at = 0; at < piece.length; at += slice) {
        const part = piece.subarray(at, at + slice);
        passed += part.length;
        const due = start + (passed / bytesPerSecond) * 1000;
        await new Promise((resolve) => setTimeout(resolve, due - performance.now()));
        controller.enqueue(part);
      }
    },
  });
}
