// Relates the page's notices to the alerts that the server keeps. A notice is an entry of the event
// list (state/notices.ts).

import type { KeptAlert } from '../server/messages';
import type { Notice } from '../state/notices';
import type { Store } from '../state/store';

/**
 * Returns the server's id of the alert that caused this notice. A notice that the page made itself
 * has no alert.
 */
export function id_of(notice: Pick<Notice, 'stream' | 'seq'>): string {
  return `${notice.stream}:${notice.seq}`;
}

/**
 * Returns true if the notice is later than the shown time `at_s`, in seconds of cell time. `at_s`
 * is null if now is shown. Notices of another server session are never later.
 */
export function is_later({ t_s, stream }: Pick<Notice, 't_s' | 'stream'>, at_s: number | null, run: string | null): boolean {
  return at_s !== null && (stream === null || stream === run) && t_s > at_s + kRounding_s;
}
// The address of the page holds the shown time in hundredths of a second.
const kRounding_s = 0.01;

/**
 * Returns the alerts raised up to the shown time. An alert without a notice is older than all
 * notices, and is therefore included.
 */
export function reported_until(alerts: readonly KeptAlert[], at_s: number | null, { notices, stream }: Pick<Store, 'notices' | 'stream'>): readonly KeptAlert[] {
  const later = new Set(notices.filter((notice) => is_later(notice, at_s, stream)).map(id_of));
  return later.size === 0 ? alerts : alerts.filter(({ id }) => !later.has(id));
}
