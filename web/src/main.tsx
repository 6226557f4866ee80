// Assembles the page: store, API, socket, router, views.

import { signal } from '@preact/signals';
import { render } from 'preact';
import { Arms } from './arms/arms';
import { install_debug_hook, show_debug_view } from './debug';
import { JogControl } from './control/jog_control';
import { Banner } from './frame/banner';
import { Header } from './frame/header';
import { listen_to_drops } from './frame/drops';
import { Pane } from './frame/pane';
import { listen_to_keys } from './frame/shortcuts';
import { use_stale } from './frame/staleness';
import { AlertList } from './alerts/alert_list';
import { Notices } from './alerts/notices';
import { Archive } from './history/archive';
import { Jobs } from './jobs/jobs';
import { MotionBook } from './motion/motion_book';
import { Comparing } from './policies/comparing';
import { KeptList } from './recordings/kept_list';
import { Player } from './recordings/player';
import { Checklist } from './recovery/checklist';
import { place_in_words } from './route/address';
import { address_bar_of, Router } from './route/router';
import { address_on_server, Api, kApi } from './server/api';
import { backoff_ms, Connection, type SocketLike, type Timers } from './server/connection';
import { earlier_events } from './server/earlier_events';
import { follow_timeline } from './server/follow_timeline';
import type { Message, Session } from './server/messages';
import { Actions } from './state/actions';
import type { App } from './state/app';
import { Seen, seen_app } from './state/as_of';
import { Settings } from './state/settings';
import { Store } from './state/store';
import { seen } from './state/seen';
import './style/tokens.css';
import './style/base.css';
import './style/layout.css';
import './style/panels.css';
import './style/pages.css';
import './style/touch.css';
import { Timeline } from './timeline/timeline';
import { CellPanel } from './view/cell_panel';
import { shown_name } from './names';
import { kText } from './strings';

const store = new Store();
const kBase = address_on_server(kApi);
const api = new Api(kBase, (url, init) => fetch(url, init));
const motions = new MotionBook((id) => api.job_motion(id));
const timers: Timers = {
  set: (callback, delay_ms) => window.setTimeout(callback, delay_ms),
  clear: (id) => window.clearTimeout(id),
};
const alerts = new AlertList(api, timers);
const jogging = new JogControl(api, timers, (id) => store.book.has_ended(id));
const session = signal<Session | null>(null);
const connection = new Connection({
  url: `${kBase.replace(/^http/, 'ws')}/ws`,
  open_socket: (url) => new WebSocket(url) as unknown as SocketLike,
  timers,
  on_message: (message) => store.receive(message, take),
  on_link: (link) => {
    store.set_link(link);
    if (link.status === 'lost') void know_who();
    if (link.status === 'open') void look_at_states();
  },
  on_reject: ({ kind, what }) => {
    if (store.reject(kind)) console.warn(`${kind} message (further ones are only counted): ${what}`);
  },
});

/** Applies a message, and asks the server for what belongs to it. */
function take(message: Message): void {
  const other_run = message.type !== 'state' && store.stream !== null && message.stream !== store.stream;
  const is_new_run = message.type === 'snapshot' && message.stream !== store.stream;
  store.take(message);
  if (is_new_run) void look_before(message.stream, message.seq);
  if (message.type === 'snapshot' || message.type === 'alert' || message.type === 'monitor') alerts.refresh_soon();
  if (message.type === 'snapshot' || message.type === 'alert') void jogging.look();  // the server publishes changes of control as alerts
  // A snapshot contains only the last ended jobs. The archive starts again to find the others.
  if (message.type === 'snapshot') archive.reopen();
  if (other_run) {
    motions.clear();
    archive.forget();
    void load_cell();
  }
}

const router = new Router(address_bar_of(window), () => store.stream);
const archive = new Archive(api, (id) => store.job(id) !== null);
const checklist = new Checklist(store);
store.on_change(() => checklist.follow());
const app: App = {
  get store() { return seen(store); },
  archive, checklist, api, motions, alerts, session, jogging, comparing: new Comparing(api, timers), covered_px: signal(0), draft: signal(''), ghost: signal(null), dragged_object: signal(null), tool: signal(null),
  actions: new Actions(api, store, timers, () => connection.retry_now()),
  router, seen: new Seen(store, router), player: new Player(store, connection, router), kept: new KeptList(api),
  settings: new Settings(shelf(), window.matchMedia('(prefers-color-scheme: light)'), (theme) => { document.documentElement.dataset['theme'] = theme; }),
};

function shelf(): Storage | null {
  try {
    return window.localStorage;
  } catch {
    return null;  // some browsers forbid access to the storage
  }
}

/** Goes to the login page if the token was revoked or the user logged out in another window. */
async function know_who(): Promise<void> {
  const answer = await api.session();
  if (!answer.ok) return;
  session.value = answer.value;
  if (answer.value.role === null) location.assign(address_on_server('login') + location.hash);
}

/** Loads events from before the page was connected. */
async function look_before(stream: string, seq: number): Promise<void> {
  store.take_earlier(await earlier_events(kBase, (url, init) => fetch(url, init), stream, seq));
}

/**
 * Loads positions that the page did not receive, because it was not connected yet or the connection
 * was lost.
 */
async function look_at_states(): Promise<void> {
  const answer = await api.states();
  if (answer.ok) store.take_earlier_states(answer.value);
}

async function load_cell(attempt = 1): Promise<void> {
  const answer = await api.cell();
  if (answer.ok) {
    store.set_cell(answer.value);
    return;
  }
  store.set_cell_fault(answer.problem.detail ?? answer.problem.title);
  timers.set(() => void load_cell(attempt + 1), backoff_ms(attempt));
}

function Page() {
  const { store } = app;
  const stale = use_stale(store);
  const then = seen_app(app);
  document.title = `${place_in_words(app.router.address.value.place)} · ${shown_name(store.cell?.name ?? kText.frame.app)}`;
  return (
    <>
      <Header app={app} />
      <Banner app={app} />
      <div class={`body${stale ? ' stale' : ''}`}>
        <main>
          <CellPanel app={app} on_view={show_debug_view} />
          <Pane app={app} />
        </main>
        <div class="dock" style={{ '--lanes': String(store.arms.size) }}>
          <Timeline app={app} />
          <Notices app={app} />
        </div>
        <aside class="side" aria-label={kText.frame.arms_and_jobs}>
          <Arms app={then} />
          <Jobs app={then} />
        </aside>
      </div>
    </>
  );
}

const root = document.getElementById('app');
if (root) render(<Page />, root);
install_debug_hook(app, () => connection.break());
listen_to_keys(app, window);
listen_to_drops(app, window);
void load_cell();
void know_who();
connection.start();
follow_timeline(api, store, timers, () => document.visibilityState === 'visible');
