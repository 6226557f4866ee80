// Distinguishes clicks on the view from drags.

const kStill_px = 4;

/**
 * Calls `heard` on each click, with the position in px from the element's top left. A drag is not a
 * click.
 */
export function on_click(element: HTMLElement, heard: (x_px: number, y_px: number) => void): void {
  let from: { x: number; y: number } | null = null;
  element.addEventListener('pointerdown', (event) => { from = event.button === 0 ? { x: event.offsetX, y: event.offsetY } : null; });
  element.addEventListener('pointerup', (event) => {
    const still = from !== null && Math.hypot(event.offsetX - from.x, event.offsetY - from.y) <= kStill_px;
    from = null;
    if (still) heard(event.offsetX, event.offsetY);
  });
}
