// What the monitor saw and what the server wants known, newest first.

import type { Store } from '../store';
import { clock } from '../wording';
import { use_store } from './use_store';

export function Notices({ store }: { store: Store }) {
  use_store(store);
  return (
    <section class="notices">
      <h2>Events<span class="count">{store.notices.length}</span></h2>
      <div class="scroll">
        {store.notices.length === 0 && <p class="none">Nothing to report yet.</p>}
        {store.notices.map((notice) => (
          <div key={notice.key} class={`notice ${notice.level}`}>
            <span class="mono">{clock(notice.t_s)}</span>
            <span class="dot" />
            <span>{notice.text}</span>
          </div>
        ))}
      </div>
    </section>
  );
}
