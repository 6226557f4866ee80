// What of the events somebody has to see to.

import type { KeptAlert } from '../server/messages';
import type { Notice } from '../state/notices';
import type { Store } from '../state/store';

/** As the server names the alert that the event was; a notice of the page's own has none. */
export function id_of(notice: Pick<Notice, 'stream' | 'seq'>): string {
  return `${notice.stream}:${notice.seq}`;
}

/** Than the time that is looked at; null: that is now. What is of another run was before. */
export function is_later({ t_s, stream }: Pick<Notice, 't_s' | 'stream'>, at_s: number | null, run: string | null): boolean {
  return at_s !== null && (stream === null || stream === run) && t_s > at_s + kRounding_s;
}
// Addresses hold hundredths of a second.
const kRounding_s = 0.01;

/** Those that had been told by then: what is not among the last notices is older than these. */
export function reported_until(alerts: readonly KeptAlert[], at_s: number | null, { notices, stream }: Pick<Store, 'notices' | 'stream'>): readonly KeptAlert[] {
  const later = new Set(notices.filter((notice) => is_later(notice, at_s, stream)).map(id_of));
  return later.size === 0 ? alerts : alerts.filter(({ id }) => !later.has(id));
}
