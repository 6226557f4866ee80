// The permissions of the user, which depend on the role. The server decides; the page only explains
// beforehand why a command would be refused.

import type { Session } from '../server/messages';
import { why_not_connected } from '../wording';
import { kText } from '../strings';
import type { App } from './app';

/** Returns true if the user may only view. */
export function is_viewer(session: Session | null): boolean {
  return session?.role === 'viewer';
}

/** Returns why the user's role allows no commands, or null if it allows them. */
export function why_not_permitted(session: Session | null): string | null {
  return is_viewer(session) ? kText.server.role : null;
}

/** Returns why the user can give no command now, or null if commands are possible. */
export function why_no_command({ store, session }: Pick<App, 'store' | 'session'>): string | null {
  return why_not_connected(store.link) ?? why_not_permitted(session.value);
}
