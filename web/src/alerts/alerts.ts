// What of the events somebody has to see to.

import type { Notice } from '../state/store';

/** As the server names the alert that the event was; a notice of the page's own has none. */
export function id_of(notice: Pick<Notice, 'stream' | 'seq'>): string {
  return `${notice.stream}:${notice.seq}`;
}
