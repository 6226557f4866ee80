// Which alerts somebody has seen to: who, and when. Kept in this browser, for this run of the server, and
// shared by its windows.

import { signal } from '@preact/signals';
import type { Shelf } from './settings';

export interface Acknowledgement { who: string; at: string }

const kKey = 'armloom.acknowledged';
const kMost = 500;

export class Acknowledged {
  private readonly known_ = signal<ReadonlyMap<string, Acknowledgement>>(new Map());

  constructor(private readonly shelf_: Shelf | null, private readonly now_: () => Date = () => new Date()) {
    this.read();
  }

  of(alert: string): Acknowledgement | null {
    return this.known_.value.get(alert) ?? null;
  }

  acknowledge(alerts: readonly string[], who: string): void {
    const at = this.now_().toISOString();
    const entries = [...this.known_.value, ...alerts.map((alert) => [alert, { who, at }] as const)];
    this.known_.value = new Map(entries.slice(-kMost));
    try {
      this.shelf_?.setItem(kKey, JSON.stringify([...this.known_.value]));
    } catch {
      // A browser that keeps nothing: it lasts as long as the page.
    }
  }

  /** Another window has written. */
  read(): void {
    try {
      const list = JSON.parse(this.shelf_?.getItem(kKey) ?? '[]') as unknown;
      if (Array.isArray(list)) this.known_.value = new Map(list.filter(is_entry));
    } catch {
      // What cannot be read is not known.
    }
  }
}

function is_entry(entry: unknown): entry is [string, Acknowledgement] {
  if (!Array.isArray(entry) || typeof entry[0] !== 'string') return false;
  const { who, at } = (entry[1] ?? {}) as Partial<Acknowledgement>;
  return typeof who === 'string' && typeof at === 'string';
}
