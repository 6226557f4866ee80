// The current address as a signal, in sync with the browser's address bar.

import { signal, type ReadonlySignal } from '@preact/signals';
import { address_text, parse_address, type Address, type Camera, type Place } from './address';

/** The members of a browser's window that are used here. */
export interface AddressBar {
  read(): string;
  push(hash: string): void;
  replace(hash: string): void;
  on_change(listener: () => void): void;
}

export class Router {
  private readonly address_;

  /** `run` returns the id of the current server session, or null before the first message. */
  constructor(private readonly bar_: AddressBar, private readonly run_: () => string | null = () => null) {
    this.address_ = signal<Address>(parse_address(bar_.read()));
    bar_.on_change(() => { this.address_.value = parse_address(bar_.read()); });
  }

  get address(): ReadonlySignal<Address> {
    return this.address_;
  }

  get place(): Place {
    return this.address_.value.place;
  }

  /** Returns the address of a page, with the current time and camera. */
  href(place: Place): string {
    return address_text({ ...this.address_.value, place });
  }

  go(place: Place): void {
    this.bar_.push(this.href(place));
    this.address_.value = { ...this.address_.value, place };
  }

  /** Changes the time in the address without a new entry in the browser's history. */
  show_time(t_s: number | null): void {
    this.see({ t_s, run: t_s === null ? null : this.run_()?.slice(0, 8) ?? null });
  }
  look_from(camera: Camera | null): void {
    this.see({ camera });
  }

  private see(seen: Partial<Address>): void {
    const next = { ...this.address_.peek(), ...seen };
    const text = address_text(next);
    if (text === address_text(this.address_.peek())) return;
    this.bar_.replace(text);
    this.address_.value = next;
  }
}

export function address_bar_of(window: Window): AddressBar {
  return {
    read: () => window.location.hash,
    push: (hash) => { window.history.pushState(null, '', hash); },
    replace: (hash) => { window.history.replaceState(window.history.state, '', hash); },
    on_change: (listener) => {
      window.addEventListener('popstate', listener);
      window.addEventListener('hashchange', listener);
    },
  };
}
