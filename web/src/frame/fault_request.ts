// The faults of simulated arms as a form edits them. Pure.

import type { Cell, Fault, FaultKind, FaultRequest } from '../server/messages';
import { shown_name } from '../names';
import { kText } from '../strings';
import { number_in_words } from '../wording';
import { number_in } from './number_text';

const kWords = kText.faults;

export const kKinds: Record<FaultKind, string> = kWords.kinds;
const kValues: Partial<Record<FaultKind, { unit: string; usual: number }>> = kWords.values;
const kOnce: readonly FaultKind[] = ['fault', 'reject'];

/** Returns the arms with simulated controllers. Other controllers take no faults. */
export function simulated_arms({ robots }: Pick<Cell, 'robots'>): string[] {
  return robots.flatMap(({ controller, arms }) => (controller.type === 'sim' ? arms.map(({ name }) => name) : []));
}

/** Returns the unit and usual value of this kind of fault, or null if it has no value. */
export function value_of(kind: FaultKind): { unit: string; usual: number } | null {
  return kValues[kind] ?? null;
}

export function fault_in_words({ kind, arm, value }: Fault): string {
  return kWords.entry(kind, shown_name(arm)) + (value_of(kind) ? `: ${number_in_words(value)}` : '');
}

/** Returns true if a fault of this kind may have a duration. */
export function may_last(kind: FaultKind): boolean {
  return !kOnce.includes(kind);
}

/** Returns the request, or null if a text is not a number. An empty `for_s` means no end. */
export function request_of(arm: string, kind: FaultKind, value: string, for_s: string): FaultRequest | null {
  const request: FaultRequest = { arm, kind };
  if (value_of(kind)) {
    const number = number_in(value);
    if (number === null) return null;
    request.value = number;
  }
  if (may_last(kind) && for_s.trim() !== '') {
    const number = number_in(for_s);
    if (number === null) return null;
    request.for_s = number;
  }
  return request;
}
