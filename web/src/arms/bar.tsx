// A progress bar.

export function Bar({ share }: { share: number }) {
  return <div class="bar" aria-hidden="true"><div style={{ transform: `scaleX(${share.toFixed(4)})` }} /></div>;
}
