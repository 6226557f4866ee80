// Alerts are the notices that somebody has to see to: warnings and errors.

import type { App } from '../state/app';
import type { Notice } from '../state/store';

/** The same in every window, and after a reload. */
export function key_of(notice: Pick<Notice, 'stream' | 'seq' | 'key'>): string {
  return `${notice.stream}:${notice.seq ?? `page-${notice.key}`}`;
}

export function alerts_of(app: Pick<App, 'store'>): Notice[] {
  return app.store.notices.filter(({ level }) => level !== 'info');
}

export function to_see_to(app: Pick<App, 'store' | 'acknowledged'>): Notice[] {
  return alerts_of(app).filter((notice) => app.acknowledged.of(key_of(notice)) === null);
}
