// Photographs of squares that this device keeps, each with the plans under whose dances it lies.

/** So many are kept: each new one beyond that takes the place of the oldest. */
const MOST = 12;
const [BASE, STORE, PLANS] = ["benchdragon", "photographs", "plans"];

/** A photograph: its picture, how it lies on the ground, and the hashes of its plans. @typedef {{ id?: number, picture: Blob, pose: object, plans: string[] }} KeptPhoto */

/** @template T @param {IDBRequest<T>} request @returns {Promise<T>} */
function answer(request) {
  return new Promise((done, failed) => {
    request.onsuccess = () => done(request.result);
    request.onerror = () => failed(request.error);
  });
}

/** The photographs, in a store that is made where there is none. @returns {Promise<IDBDatabase>} */
function opened() {
  const opening = indexedDB.open(BASE, 1);
  opening.onupgradeneeded = () => {
    const store = opening.result.createObjectStore(STORE, { keyPath: "id", autoIncrement: true });
    store.createIndex(PLANS, PLANS, { multiEntry: true });
  };
  return answer(opening);
}

/**
 * What is done with the photographs; null where the browser keeps none.
 * @template T
 * @param {IDBTransactionMode} mode
 * @param {(store: IDBObjectStore) => Promise<T>} work
 */
async function stored(mode, work) {
  try {
    if (!globalThis.indexedDB) return null;
    const base = await opened();
    try {
      const change = base.transaction(STORE, mode);
      const whole = new Promise((done, failed) => {
        change.oncomplete = done;
        change.onabort = () => failed(change.error);
      });
      const [found] = await Promise.all([work(change.objectStore(STORE)), whole]);
      return found;
    } finally {
      base.close();
    }
  } catch (error) {
    if (error instanceof DOMException) return null; // refused, or no room is left
    throw error;
  }
}

/** The photograph that lies under the dance of a plan; null where none is kept. @param {string} plan its hash @returns {Promise<KeptPhoto | null>} */
export async function photoUnder(plan) {
  const found = await stored("readonly", (store) => answer(store.index(PLANS).getAll(plan)));
  return found?.at(-1) ?? null;
}

/** Keep a photograph, the one before of the same number no more; its number, null where it is not kept. @param {KeptPhoto} photo @returns {Promise<number | null>} */
export function keepPhoto(photo) {
  return stored("readwrite", async (store) => {
    const number = await answer(store.put(photo));
    const all = await answer(store.getAllKeys());
    for (const old of all.slice(0, -MOST)) await answer(store.delete(old));
    return /** @type {number} */ (number);
  });
}

/** Keep a photograph no more. @param {number} number */
export function forgetPhoto(number) {
  return stored("readwrite", (store) => answer(store.delete(number)));
}
