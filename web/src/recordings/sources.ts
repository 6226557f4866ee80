// What a recording is read from: files that were chosen, or those of the server's data folder, which come
// while they are read. However large they are, no more than a piece is held.

import type { Fetch } from '../server/api';
import { kText } from '../strings';

export interface Source {
  /** So many are expected. */
  bytes: number;
  open(stop: AbortSignal): Promise<ReadableStream<Uint8Array>>;
}

export function of_blob(blob: Blob): Source {
  return { bytes: blob.size, open: () => Promise.resolve(blob.stream()) };
}

export function of_server(address: string, bytes: number, fetch: Fetch): Source {
  return {
    bytes,
    open: async (stop) => {
      const response = await fetch(address, { signal: stop });
      if (!response.ok || !response.body) throw new Error(kText.recordings.server_answers(response.status, response.statusText));
      return response.body;
    },
  };
}

const kPiece = 1 << 16;
// The page goes on to answer clicks meanwhile.
const kBreath_ms = 20;

/** Its text, cut anywhere. `told` hears of so many bytes more; throws when it is stopped, or breaks off. */
export async function* texts_of(source: Source, stop: AbortSignal, told: (bytes: number) => void): AsyncGenerator<string> {
  const reader = (await source.open(stop)).getReader();
  const decoder = new TextDecoder();
  let breath_ms = performance.now();
  try {
    for (let part = await reader.read(); !part.done; part = await reader.read()) {
      for (let from = 0; from < part.value.length; from += kPiece) {
        const piece = part.value.subarray(from, from + kPiece);
        yield decoder.decode(piece, { stream: true });
        told(piece.length);
        if (performance.now() - breath_ms > kBreath_ms) {
          await new Promise((done) => setTimeout(done));
          breath_ms = performance.now();
        }
        stop.throwIfAborted();
      }
    }
    yield decoder.decode();
  } finally {
    await reader.cancel().catch(() => undefined);  // it has broken off already
  }
}
