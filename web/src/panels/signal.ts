// A value of the page itself (which drawer is open) that components follow.

import { useEffect, useState } from 'preact/hooks';

export interface Signal<T> {
  get(): T;
  set(value: T): void;
  subscribe(listener: () => void): () => void;
}

export function signal_of<T>(initial: T): Signal<T> {
  let value = initial;
  const listeners = new Set<() => void>();
  return {
    get: () => value,
    set: (next) => {
      value = next;
      for (const listener of listeners) listener();
    },
    subscribe: (listener) => {
      listeners.add(listener);
      return () => listeners.delete(listener);
    },
  };
}

export function use_signal<T>(signal: Signal<T>): T {
  const [value, set_value] = useState(signal.get());
  useEffect(() => signal.subscribe(() => set_value(signal.get())), [signal]);
  return value;
}
