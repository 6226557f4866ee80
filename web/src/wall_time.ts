// Writes wall-clock times so that they cannot be misread: year first, 24 hours, local time with its
// offset from UTC. Pure.

/** Returns the time in the form 2026-11-26 14:03:07 +01:00. */
export function wall_time(at: string | number): string {
  const date = new Date(at);
  return Number.isNaN(date.getTime()) ? String(at) : `${day(date)} ${time(date)} ${offset(date)}`;
}

/**
 * Returns the short form for tables, without today's date and without the offset. The title of the
 * element has the full form.
 */
export function short_wall_time(at: string | number, now_ms: number): string {
  const date = new Date(at);
  if (Number.isNaN(date.getTime())) return String(at);
  return day(date) === day(new Date(now_ms)) ? time(date) : `${day(date)} ${time(date)}`;
}

const two = (n: number) => String(n).padStart(2, '0');

function day(date: Date): string {
  return `${date.getFullYear()}-${two(date.getMonth() + 1)}-${two(date.getDate())}`;
}

function time(date: Date): string {
  return `${two(date.getHours())}:${two(date.getMinutes())}:${two(date.getSeconds())}`;
}

function offset(date: Date): string {
  const minutes = -date.getTimezoneOffset();
  const [hours, rest] = [Math.floor(Math.abs(minutes) / 60), Math.abs(minutes) % 60];
  return minutes === 0 ? 'UTC' : `${minutes < 0 ? '−' : '+'}${two(hours)}:${two(rest)}`;
}
