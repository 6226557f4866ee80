// Sources of a recording: files chosen by the user, or files of the server. They are streamed in
// pieces, so that large files need little memory.

import type { Fetch } from '../server/api';
import { kText } from '../strings';

export interface Source {
  /** The size that the browser or the server states. */
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
// Reading pauses this often, so that the page can answer clicks.
const kBreath_ms = 20;

/**
 * Yields the text in parts that may be split anywhere. `on_bytes` receives the number of bytes of
 * each part. Throws if reading is canceled or fails.
 */
export async function* texts_of(source: Source, stop: AbortSignal, on_bytes: (bytes: number) => void): AsyncGenerator<string> {
  const reader = (await source.open(stop)).getReader();
  const decoder = new TextDecoder();
  let breath_ms = performance.now();
  try {
    for (let part = await reader.read(); !part.done; part = await reader.read()) {
      for (let from = 0; from < part.value.length; from += kPiece) {
        const piece = part.value.subarray(from, from + kPiece);
        yield decoder.decode(piece, { stream: true });
        on_bytes(piece.length);
        if (performance.now() - breath_ms > kBreath_ms) {
          await new Promise((done) => setTimeout(done));
          breath_ms = performance.now();
        }
        stop.throwIfAborted();
      }
    }
    yield decoder.decode();
  } finally {
    await reader.cancel().catch(() => undefined);  // the reader may be closed already
  }
}
