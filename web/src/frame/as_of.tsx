// A line above a page while a past time is shown. It states this time, and which parts of the page
// show the present all the same.

import type { ComponentChildren } from 'preact';
import type { App } from '../state/app';
import { is_known } from '../state/as_of';
import { kText } from '../strings';
import { clock } from '../wording';

export function AsOf({ app, children }: { app: App; children?: ComponentChildren }) {
  const { t_s } = app.router.address.value;
  if (t_s === null) return null;
  const known = is_known(app.seen.store.value);
  return (
    <p class="hint looked-at as-of" role="status" data-test="as-of">
      <b>{known ? kText.past.state_at : kText.past.state_unknown_at} <span class="mono">{clock(t_s)}</span>.</b> {children}{' '}
      <button class="small" onClick={() => app.router.show_time(null)}>{app.store.link.status === 'recording' ? kText.past.go_to_end : kText.past.go_to_now}</button>
    </p>
  );
}
