// The numbers of the events of a run: the last one, and how many were left out or came twice.

import type { SequencedMessage } from '../server/messages';

export interface Numbers { readonly last: number; readonly missed: number; readonly doubled: number }

export const kNoNumbers: Numbers = { last: 0, missed: 0, doubled: 0 };

/** A snapshot holds all until its number. */
export function counted({ last, missed, doubled }: Numbers, { type, seq }: Pick<SequencedMessage, 'type' | 'seq'>): Numbers {
  if (type === 'snapshot') return { last: seq, missed: 0, doubled: 0 };
  if (seq > last) return { last: seq, missed: missed + seq - last - 1, doubled };
  return { last, missed, doubled: doubled + 1 };
}
