// Reads a long text in a web worker, so that the page keeps answering clicks and Stop.

import { composed, type Composed } from './composed';

/**
 * Texts longer than this, in characters, are not shown in the text field, because browsers take
 * seconds for their layout.
 */
export const kLong = 200_000;

/** The members of a Worker that are used here. */
export interface WorkerLike {
  postMessage(text: string): void;
  terminate(): void;
  onmessage: ((event: MessageEvent<Composed>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
}

const kMake = (): WorkerLike => new Worker(new URL('./compose_worker.ts', import.meta.url), { type: 'module' });

/**
 * The last text and its result. A file is read when it is chosen, and again when its text is shown;
 * the second reading uses this result.
 */
let last: { of: string; made: Composed } | null = null;

/**
 * Returns composed(text), computed in a web worker. Rejects if `stop` is aborted. If the worker
 * cannot load, for example after an update of the server's files, the page reads the text itself.
 */
export async function composed_in_worker(text: string, stop: AbortSignal, make: () => WorkerLike = kMake): Promise<Composed> {
  if (last?.of === text) return last.made;
  const made = await read_in_worker(text, stop, make);
  last = { of: text, made };
  return made;
}

function read_in_worker(text: string, stop: AbortSignal, make: () => WorkerLike): Promise<Composed> {
  return new Promise((done, fail) => {
    const worker = make();
    const end = () => {
      worker.terminate();
      stop.removeEventListener('abort', give_up);
    };
    const give_up = () => {
      end();
      fail(new Error('reading was canceled'));
    };
    worker.onmessage = ({ data }) => {
      end();
      done(data);
    };
    worker.onerror = () => {
      end();
      done(composed(text));
    };
    stop.addEventListener('abort', give_up);
    if (stop.aborted) give_up();
    else worker.postMessage(text);
  });
}
