// Letting go between calls of kernels, so that a Worker hears what it is told meanwhile.

/** Told how far a long question is: its share, 0 to 1, and what is being done. */
/** @typedef {(share: number, text: string) => void} Progress */

/** @type {Progress} */
export const silent = () => {};

const channel = new MessageChannel();
/** @type {Array<() => void>} */
const waiting = [];
channel.port1.onmessage = () => waiting.shift()?.();
const port = /** @type {any} */ (channel.port1);
// Node ends where nothing but this port is left.
port.unref?.();

/** What is done at each tick: it throws where nobody waits any more for the question under way. */
let heed = () => {};

/** @param {() => void} check what is done at each tick from now on */
export function heedAtTicks(check) {
  heed = check;
}

/** Go on as soon as all that waits to be heard was heard; timers would cost 4 ms each. */
export async function tick() {
  await heard();
  heed();
}

function heard() {
  return new Promise((resolve) => {
    port.ref?.();
    waiting.push(() => {
      if (!waiting.length) port.unref?.();
      resolve(undefined);
    });
    channel.port2.postMessage(0);
  });
}
