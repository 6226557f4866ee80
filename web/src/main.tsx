// Puts the page together: store, server, socket, view.

import { render } from 'preact';
import { Api } from './api';
import { backoff_ms, Connection, type SocketLike, type Timers } from './connection';
import { install_debug_hook } from './debug';
import { follow_timeline } from './follow_timeline';
import { Actions } from './panels/actions';
import { Arms } from './panels/arms';
import { Banner } from './panels/banner';
import { CellPanel } from './panels/cell_panel';
import { Header } from './panels/header';
import { Jobs } from './panels/jobs';
import { Notices } from './panels/notices';
import { Timeline } from './panels/timeline';
import { Store } from './store';
import './style/base.css';
import './style/layout.css';
import './style/panels.css';

const kBase = '/api/v1';

const store = new Store();
const api = new Api(kBase, (url, init) => fetch(url, init));
const timers: Timers = {
  set: (callback, delay_ms) => window.setTimeout(callback, delay_ms),
  clear: (id) => window.clearTimeout(id),
};
const connection = new Connection({
  url: `${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}${kBase}/ws`,
  open_socket: (url) => new WebSocket(url) as unknown as SocketLike,
  timers,
  on_message: (message) => {
    const other_run = message.type !== 'state' && store.stream !== null && message.stream !== store.stream;
    store.take(message);
    if (other_run) void load_cell();
  },
  on_link: (link) => store.set_link(link),
  on_reject: ({ kind, what }) => {
    if (store.reject(kind)) console.warn(`${kind} message (further ones are only counted): ${what}`);
  },
});
const actions = new Actions(api, store, timers, () => connection.retry_now());

const follow = (take: Parameters<typeof follow_timeline>[4]) =>
  follow_timeline(api, store, timers, () => document.visibilityState === 'visible', take);

async function load_cell(attempt = 1): Promise<void> {
  const answer = await api.cell();
  if (answer.ok) {
    store.set_cell(answer.value);
    document.title = `${answer.value.name} · Armloom`;
    return;
  }
  store.set_cell_fault(answer.problem.detail ?? answer.problem.title);
  timers.set(() => void load_cell(attempt + 1), backoff_ms(attempt));
}

function Page() {
  return (
    <>
      <Header store={store} actions={actions} />
      <Banner store={store} actions={actions} />
      <main>
        <CellPanel store={store} actions={actions} on_view={(view) => install_debug_hook(store, view)} />
        <div class="dock">
          <Timeline store={store} follow={follow} />
          <Notices store={store} />
        </div>
        <div class="side">
          <Arms store={store} />
          <Jobs store={store} actions={actions} />
        </div>
      </main>
    </>
  );
}

const root = document.getElementById('app');
if (root) render(<Page />, root);
void load_cell();
connection.start();
