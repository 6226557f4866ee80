// A long text is read beside the page, which goes on to answer clicks and Stop meanwhile.

import { composed, type Composed } from './composed';

/** A longer one is not put into the text field either: a browser lays it out for seconds. */
export const kLong = 200_000;

/** The part of a Worker that is used. */
export interface WorkerLike {
  postMessage(text: string): void;
  terminate(): void;
  onmessage: ((event: MessageEvent<Composed>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
}

const kMake = (): WorkerLike => new Worker(new URL('./compose_worker.ts', import.meta.url), { type: 'module' });

/** A file is looked at before its text is taken: what it came to is not made twice. */
let last: { of: string; made: Composed } | null = null;

/**
 * The same as composed(); `stop` gives it up, which rejects. Where nothing can run beside the page, as when the
 * server was updated under it and has other files now, the page reads it itself.
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
