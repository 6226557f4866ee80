// A question that takes the place of the button that asks it.

import { useRef, useState } from 'preact/hooks';

export interface Question {
  asked: boolean;
  ask(): void;
  /** Whoever takes it back has the button under the focus again. */
  take_back(): void;
  /** It is answered. */
  end(): void;
  /** The button's `ref`. */
  button(element: HTMLButtonElement | null): void;
}

export function use_question(): Question {
  const [asked, set_asked] = useState(false);
  const taken_back = useRef(false);
  return {
    asked,
    ask: () => set_asked(true),
    take_back: () => {
      taken_back.current = true;
      set_asked(false);
    },
    end: () => set_asked(false),
    button: (element) => {
      if (!element || !taken_back.current) return;
      taken_back.current = false;
      element.focus();
    },
  };
}
