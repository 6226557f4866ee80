// Relates events to the alerts that the server keeps.

import type { KeptAlert } from '../server/messages';
import type { Notice } from '../state/notices';
import type { Store } from '../state/store';

/**
 * Returns the server's id of the alert that this event was. Notices of the page itself have none.
 */
export function id_of(notice: Pick<Notice, 'stream' | 'seq'>): string {
  return `${notice.stream}:${notice.seq}`;
}

/**
 * Returns true if the notice is later than the shown time. `at_s` is null if the shown time is now.
 * Notices of another server session are earlier.
 */
export function is_later({ t_s, stream }: Pick<Notice, 't_s' | 'stream'>, at_s: number | null, run: string | null): boolean {
  return at_s !== null && (stream === null || stream === run) && t_s > at_s + kRounding_s;
}
// Addresses hold hundredths of a second.
const kRounding_s = 0.01;

/**
 * Returns the alerts raised up to the shown time. Alerts that are not among the last notices are
 * older.
 */
export function reported_until(alerts: readonly KeptAlert[], at_s: number | null, { notices, stream }: Pick<Store, 'notices' | 'stream'>): readonly KeptAlert[] {
  const later = new Set(notices.filter((notice) => is_later(notice, at_s, stream)).map(id_of));
  return later.size === 0 ? alerts : alerts.filter(({ id }) => !later.has(id));
}
