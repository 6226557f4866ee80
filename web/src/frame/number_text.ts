// Reads one number as a person types it. Pure.

import { kText } from '../strings';

/** Returns null if the text is not a number. A comma is refused, because 1,500 is ambiguous. */
export function number_in(text: string): number | null {
  const value = text.trim() === '' ? NaN : Number(text);
  return Number.isFinite(value) ? value : null;
}

/** Returns why the text is not a number. */
export function no_number(text: string): string {
  return `${kText.plan.not_a_number(text.trim())}${text.includes(',') ? kText.plan.decimal_point : ''}`;
}

/** Adds to the number, rounded to 6 decimals. */
export function stepped(text: string, by: number): string {
  const value = number_in(text);
  return value === null ? text : String(Number((value + by).toFixed(6)));
}
