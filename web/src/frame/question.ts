// A question for confirmation. It replaces the button that asks for it.

import { useRef, useState } from 'preact/hooks';

export interface Question {
  asked: boolean;
  ask(): void;
  /** Closes the question without an answer, and returns the focus to the button. */
  take_back(): void;
  /** Closes the question after it was answered. */
  end(): void;
  /** The button must pass this as its `ref`, so that it can get the focus back. */
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
