// What was pasted or read from a file, ready to be judged and sent. Pure. Of a long text it is made beside the
// page (long_text.ts), so what is sent is held in blobs, which are handed over at once however long they are.

import { cut_text } from '../names';
import { parts_of, thinned, type Part } from '../motion/pasted';
import { kText } from '../strings';
import { bodies_of, read_batch, type Body } from './batch';

export interface Composed {
  kind: 'one' | 'batch';
  bodies: Body[];
  /** What is sent, and where. */
  request: { path: '/batches' | '/jobs'; body: Blob };
  /** The motions in it, as they are shown. */
  parts: Part[];
  /** Why it is no job; null: as far as is seen here it is one. */
  fault: string | null;
}

/** More points would take the page long to be handed, and nobody sees a ghost of them. */
const kMostShown = 10_000;

export function composed(text: string): Composed {
  const batch = read_batch(text);
  return {
    kind: batch.kind, bodies: bodies_of(batch), parts: thinned(parts_of(batch), kMostShown), fault: fault_in(text),
    request: batch.kind === 'batch' ? { path: '/batches', body: new Blob([JSON.stringify({ atomic: true, jobs: batch.jobs })]) } : { path: '/jobs', body: new Blob([batch.text]) },
  };
}

/** Why a text is no JSON of a job; it stands behind the name of its file. */
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
