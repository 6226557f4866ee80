// One number as a person types it. Pure.

import { kText } from '../strings';

/** Null: it is none. With a comma it is none, either: who writes 1,500 may mean the one or the other. */
export function number_in(text: string): number | null {
  const value = text.trim() === '' ? NaN : Number(text);
  return Number.isFinite(value) ? value : null;
}

/** Why it is none, in words. */
export function no_number(text: string): string {
  return `${kText.plan.not_a_number(text.trim())}${text.includes(',') ? kText.plan.decimal_point : ''}`;
}

/** So much more, without digits that only a computer makes. */
export function stepped(text: string, by: number): string {
  const value = number_in(text);
  return value === null ? text : String(Number((value + by).toFixed(6)));
}
