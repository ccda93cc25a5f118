// For how long a page's main thread does not answer.

/** Runs in the page: the longest wait for a message, in milliseconds, until isOver() holds. */
async function longestWaitUntil(isOver) {
  const { port1, port2 } = new MessageChannel();
  let longest = 0;
  while (!isOver()) {
    const start = performance.now();
    await new Promise((resolve) => {
      port1.onmessage = resolve;
      port2.postMessage(0);
    });
    longest = Math.max(longest, performance.now() - start);
    await new Promise((resolve) => setTimeout(resolve, 4));
  }
  return longest;
}

/** Gives the page `longestWaitUntil`. */
export const addLongestWait = (page) =>
  page.evaluate(`window.longestWaitUntil = ${longestWaitUntil}`);
