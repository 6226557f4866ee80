// The permissions of the user, by role. The server decides; the page explains it beforehand.

import type { Session } from '../server/messages';
import { why_not_connected } from '../wording';
import { kText } from '../strings';
import type { App } from './app';

/** Returns true if the user may only view. */
export function is_viewer(session: Session | null): boolean {
  return session?.role === 'viewer';
}

/** Returns why the role allows no commands, or null. */
export function why_not_permitted(session: Session | null): string | null {
  return is_viewer(session) ? kText.server.role : null;
}

/** Returns why no command can be given now, or null. */
export function why_no_command({ store, session }: Pick<App, 'store' | 'session'>): string | null {
  return why_not_connected(store.link) ?? why_not_permitted(session.value);
}
