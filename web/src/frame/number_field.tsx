// A text field for one number. It is not a number field, because Chromium silently turns 0,15 into
// 015 there. The up and down arrow keys change the number by one step.

import { number_in, stepped } from './number_text';

interface Props { value: string; step: number; test: string; narrow?: boolean; change(text: string): void }

export function NumberField({ value, step, test, narrow, change }: Props) {
  const number = number_in(value);
  const on_key = (event: KeyboardEvent) => {
    const steps = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    if (steps === undefined) return;
    event.preventDefault();
    change(stepped(value, steps * step));
  };
  return (
    <input type="text" role="spinbutton" class={narrow ? 'narrow' : ''} required autocomplete="off" spellcheck={false} value={value} data-test={test}
      aria-valuenow={number ?? undefined} aria-valuetext={value} aria-invalid={number === null}
      onKeyDown={on_key} onInput={(event) => change(event.currentTarget.value)} />
  );
}
