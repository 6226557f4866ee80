// Prepares pasted text, or the text of a file, for checking and sending. Pure. Long texts are read
// in a web worker (long_text.ts). Request bodies are blobs, because a worker passes a blob to the
// page at once, whatever its length.

import { cut_text } from '../names';
import { parts_of, thinned, type Part } from '../motion/pasted';
import { kText } from '../strings';
import { bodies_of, read_batch, type Body } from './batch';

export interface Composed {
  kind: 'one' | 'batch';
  bodies: Body[];
  /** The request that submits the jobs. */
  request: { path: '/batches' | '/jobs'; body: Blob };
  /** The motions to preview. */
  parts: Part[];
  /** Says why the text is not a job; null if no fault was found before sending. */
  fault: string | null;
}

/**
 * Largest number of points of a preview. More points would take long to pass from the worker to the
 * page, and a preview does not need them.
 */
const kMostShown = 10_000;

export function composed(text: string): Composed {
  const batch = read_batch(text);
  return {
    kind: batch.kind, bodies: bodies_of(batch), parts: thinned(parts_of(batch), kMostShown), fault: fault_in(text),
    request: batch.kind === 'batch' ? { path: '/batches', body: new Blob([JSON.stringify({ atomic: true, jobs: batch.jobs })]) } : { path: '/jobs', body: new Blob([batch.text]) },
  };
}

/**
 * Returns why a text is not the JSON of a job, or null. The caller puts the file name before the
 * reason.
 */
function fault_in(text: string): string | null {
  if (text.trim() === '') return kText.compose.empty;
  if (!/^\s*[[{]/.test(text)) return kText.compose.not_json(cut_text(text.trim().split('\n', 1)[0] ?? '', 40));
  try {
    JSON.parse(text);
    return null;
  } catch (error) {
    return kText.compose.bad_json(error instanceof Error ? cut_text(error.message, 160) : String(error));
  }
}
