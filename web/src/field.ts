// Reading JSON with a place, so that a fault says where it stands and what was found there.

export type Parsed<T> = { ok: true; value: T } | { ok: false; fault: string };

class ParseFault extends Error {}

export class Field {
  constructor(readonly value: unknown, readonly pointer: string) {}

  get(key: string): Field {
    if (typeof this.value !== 'object' || this.value === null || Array.isArray(this.value)) this.fail('an object');
    const object = this.value as Record<string, unknown>;
    return at(Object.hasOwn(object, key) ? object[key] : undefined, `${this.pointer}/${key}`);
  }
  text(): string {
    return typeof this.value === 'string' ? this.value : this.fail('a string');
  }
  number(): number {
    return typeof this.value === 'number' && Number.isFinite(this.value) ? this.value : this.fail('a number');
  }
  flag(): boolean {
    return typeof this.value === 'boolean' ? this.value : this.fail('true or false');
  }
  one_of<T extends string>(choices: readonly T[]): T {
    return choices.find((c) => c === this.value) ?? this.fail(`one of ${choices.join(', ')}`);
  }
  or_null<T>(read: (f: Field) => T): T | null {
    return this.value === undefined || this.value === null ? null : read(this);
  }
  list<T>(read: (f: Field) => T): T[] {
    if (!Array.isArray(this.value)) this.fail('a list');
    return (this.value as unknown[]).map((e, i) => read(at(e, `${this.pointer}/${i}`)));
  }
  list_or_empty<T>(read: (f: Field) => T): T[] {
    return this.or_null((f) => f.list(read)) ?? [];
  }
  triple(): [number, number, number] {
    const [x, y, z, ...rest] = this.list((f) => f.number());
    if (x === undefined || y === undefined || z === undefined || rest.length) this.fail('three numbers');
    return [x, y, z];
  }
  pair(): [number, number] {
    const [from, to, ...rest] = this.list((f) => f.number());
    if (from === undefined || to === undefined || rest.length) this.fail('two numbers');
    return [from, to];
  }
  /** An empty text says as little as none. */
  text_or_null(): string | null {
    return this.or_null((f) => f.text()) || null;
  }
  /** Two texts; null when there are none. */
  text_pair_or_null(): [string, string] | null {
    const texts = this.list_or_empty((f) => f.text());
    if (texts.length === 0) return null;
    const [a, b, ...rest] = texts;
    if (a === undefined || b === undefined || rest.length) this.fail('two strings');
    return [a, b];
  }
  numbers_by_name(): Record<string, number> {
    if (typeof this.value !== 'object' || this.value === null || Array.isArray(this.value)) this.fail('an object');
    for (const key of Object.keys(this.value as object)) this.get(key).number();
    return this.value as Record<string, number>;
  }
  texts_by_name(): Record<string, string> {
    if (typeof this.value !== 'object' || this.value === null || Array.isArray(this.value)) this.fail('an object');
    for (const key of Object.keys(this.value as object)) this.get(key).text();
    return this.value as Record<string, string>;
  }
  fail(expected: string): never {
    const found = JSON.stringify(this.value)?.slice(0, 60) ?? 'nothing';
    throw new ParseFault(`${this.pointer || '/'}: expected ${expected}, found ${found}`);
  }
}

export function at(value: unknown, pointer: string): Field {
  return new Field(value, pointer);
}

export function attempt<T>(read: () => T): Parsed<T> {
  try {
    return { ok: true, value: read() };
  } catch (error) {
    return { ok: false, fault: fault_of(error) };
  }
}

export function fault_of(error: unknown): string {
  if (error instanceof ParseFault) return error.message;
  if (error instanceof SyntaxError) return `not JSON: ${error.message}`;
  throw error;
}
