// The state that the views show: the present, or a past state derived from the log of events. Parts
// of a past state that are unknown are shown as unknown. The present state never replaces them.

import { signal, type ReadonlySignal } from '@preact/signals';
import type { Router } from '../route/router';
import { instant_of, is_of_this_run } from './instant';
import type { App } from './app';
import { Store } from './store';

/**
 * Returns the state after the first `count` events of the log. If `count` is 0, nothing is known.
 * Pure.
 */
export function state_after(count: number, now: Store): Store {
  const then = new Store(() => 0, now);
  then.begin_past(now);
  for (const message of now.log.entries.slice(0, count)) then.apply(message);
  return then;
}

/**
 * Returns the number of events of the log up to a time, or 0 if the state at this time is unknown.
 * Pure.
 */
export function events_until(t_s: number, run: string | null, now: Store): number {
  if (!is_of_this_run(run, now) || t_s > now.t_s + kRounding_s) return 0;
  const count = now.log.count_until(t_s + kRounding_s);
  const is_lost = now.log.is_torn_after(count) && instant_of({ t_s, run }, now).kind !== 'kept';
  return is_lost ? 0 : count;
}
// The address of the page holds the shown time in hundredths of a second.
const kRounding_s = 0.01;

export class Seen {
  private readonly store_;
  private key_: unknown[] = [];

  constructor(private readonly now_: Store, private readonly router_: Router) {
    this.store_ = signal<Store>(now_);
    router_.address.subscribe(() => this.look());
    now_.on_change(() => this.look());
  }

  /** The store at the shown time. It is a new object when the number of applied events changes. */
  get store(): ReadonlySignal<Store> {
    return this.store_;
  }

  private look(): void {
    const { t_s, run } = this.router_.address.peek();
    if (t_s === null) {
      this.key_ = [];
      this.store_.value = this.now_;
      return;
    }
    const { log, stream, cell, link } = this.now_;
    const count = events_until(t_s, run, this.now_);
    const key = [log.turn, count, stream, cell, link.status === 'recording', this.now_.arms.size];
    if (this.key_.length !== key.length || key.some((one, i) => one !== this.key_[i])) {
      this.key_ = key;
      this.store_.value = state_after(count, this.now_);
    }
    this.store_.peek().look_at(t_s);
  }
}

const apps = new WeakMap<Store, App>();

/** Returns the app with its store replaced by the store at the shown time. */
export function seen_app(app: App): App {
  const store = app.seen.store.value;
  if (store === app.store) return app;
  let then = apps.get(store);
  if (!then) {
    then = { ...app, store };
    apps.set(store, then);
  }
  return then;
}

/** Returns true if any part of the shown state is known. */
export function is_known({ stream, link }: Pick<Store, 'stream' | 'link'>): boolean {
  return stream !== null || link.status === 'connecting' || link.status === 'open' || link.status === 'lost';
}
