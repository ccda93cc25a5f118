/** What iterations under way throw when their decoder goes. */
export const disposed = () => new DOMException('the decoder was disposed of', 'AbortError');
