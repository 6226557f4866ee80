// Counts the sequence numbers of events: the last number, missed events, and events received twice.

import type { SequencedMessage } from '../server/messages';

export interface Numbers { readonly last: number; readonly missed: number; readonly doubled: number }

export const kNoNumbers: Numbers = { last: 0, missed: 0, doubled: 0 };

/**
 * Returns the counts after an event. A snapshot restarts the counts, because it covers all events
 * up to its number.
 */
export function counted({ last, missed, doubled }: Numbers, { type, seq }: Pick<SequencedMessage, 'type' | 'seq'>): Numbers {
  if (type === 'snapshot') return { last: seq, missed: 0, doubled: 0 };
  if (seq > last) return { last: seq, missed: missed + seq - last - 1, doubled };
  return { last, missed, doubled: doubled + 1 };
}
