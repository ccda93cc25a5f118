/** Thrown by iterations in progress when their decoder is disposed. */
export const disposed = () => new DOMException('the decoder was disposed', 'AbortError');
