// What the monitor saw and what the server wants known, newest first.

import type { App } from '../state/app';
import { use_store } from '../state/use_store';
import { clock } from '../wording';

export function Notices({ app }: { app: App }) {
  use_store(app.store);
  return (
    <section class="notices" aria-label="Events">
      <h2>Events<span class="count">{app.store.notices.length}</span></h2>
      <NoticeList app={app} />
    </section>
  );
}

const kGlyphs = { info: 'i', warning: '!', error: '✕' } as const;

export function NoticeList({ app }: { app: App }) {
  use_store(app.store);
  const { notices } = app.store;
  return (
    <div class="scroll" role="log" tabIndex={0} aria-label="Events, newest first">
      {notices.length === 0 && <p class="none">Nothing to report yet.</p>}
      {notices.map((notice) => (
        <div key={notice.key} class={`notice ${notice.level}`}>
          <span class="mono">{clock(notice.t_s)}</span>
          <span class="glyph" aria-label={notice.level} role="img">{kGlyphs[notice.level]}</span>
          <span>{notice.text}</span>
        </div>
      ))}
    </div>
  );
}
