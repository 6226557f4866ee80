// Reads one number as a person types it. Pure.

import { kText } from '../strings';

/**
 * Returns the number, or null if the text is not a number. A comma is refused, because 1,500 is
 * ambiguous.
 */
export function number_in(text: string): number | null {
  const value = text.trim() === '' ? NaN : Number(text);
  return Number.isFinite(value) ? value : null;
}

/** Returns why the text is not a number. */
export function no_number(text: string): string {
  return `${kText.plan.not_a_number(text.trim())}${text.includes(',') ? kText.plan.decimal_point : ''}`;
}

/**
 * Returns the number plus `by`, rounded to 6 decimals. A text that is not a number is returned
 * unchanged.
 */
export function stepped(text: string, by: number): string {
  const value = number_in(text);
  return value === null ? text : String(Number((value + by).toFixed(6)));
}
