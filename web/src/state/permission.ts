// What whoever uses this browser may do, by the role of their token. The server decides; the page says it before.

import type { Session } from '../server/messages';
import { why_not_connected } from '../wording';
import { kText } from '../strings';
import type { App } from './app';

/** Whose token lets them look only. */
export function is_viewer(session: Session | null): boolean {
  return session?.role === 'viewer';
}

/** Why whoever uses this browser may give no command; null: they may. */
export function why_not_permitted(session: Session | null): string | null {
  return is_viewer(session) ? kText.server.role : null;
}

/** Why no command can be given to the cell now; null when one can. */
export function why_no_command({ store, session }: Pick<App, 'store' | 'session'>): string | null {
  return why_not_connected(store.link) ?? why_not_permitted(session.value);
}
