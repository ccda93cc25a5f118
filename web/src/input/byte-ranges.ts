/** Bytes of a stream: begin … end - 1. */
export interface ByteRange {
  readonly begin: number;
  readonly end: number;
}

/** `ranges` that are in order, with those joined between which lie at most `gap` bytes. */
export function joined(ranges: readonly ByteRange[], gap: number): ByteRange[] {
  const result: ByteRange[] = [];
  for (const range of ranges) {
    const last = result.at(-1);
    if (last && range.begin - last.end <= gap)
      result[result.length - 1] = { begin: last.begin, end: range.end };
    else result.push(range);
  }
  return result;
}
