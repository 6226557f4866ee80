// The 3D view with what is laid over it: the smallest clearance, the drawer, the mark of a stop.

import { useEffect, useRef } from 'preact/hooks';
import type { Store } from '../store';
import { CellView } from '../view/cell_view';
import { clearance_in_words, millimetres } from '../wording';
import type { Actions } from './actions';
import { DrawerPanel } from './drawer';
import { use_store } from './use_store';

interface Props { store: Store; actions: Actions; on_view(view: CellView): void }

export function CellPanel({ store, actions, on_view }: Props) {
  const host = useRef<HTMLDivElement>(null);
  const panel = useRef<HTMLDivElement>(null);
  const shown = useRef<CellView | null>(null);
  use_store(store);
  const drawer = actions.drawer.value;
  useEffect(() => {
    if (!host.current) return;
    const view = new CellView(host.current, store);
    shown.current = view;
    on_view(view);
    return () => view.close();
  }, [store]);
  useEffect(() => {
    const step_aside = () => {
      const cover = panel.current?.querySelector('.drawer');
      shown.current?.set_covered(cover ? cover.getBoundingClientRect().width + 14 : 0);
    };
    step_aside();
    const observer = new ResizeObserver(step_aside);
    if (panel.current) observer.observe(panel.current);
    return () => observer.disconnect();
  }, [drawer.show]);
  return (
    <div ref={panel} class={`cell${store.stopped ? ' stopped' : ''}`}>
      <div class="view" ref={host} />
      {drawer.show === 'nothing' && (
        <button class="primary new-job" data-test="new-job" onClick={() => { actions.drawer.value = { show: 'new' }; }}>New job</button>
      )}
      <DrawerPanel store={store} actions={actions} />
      <ClearanceFigure store={store} />
      {store.stopped && <div class="stopped-mark" data-test="stopped">Stopped. Resume lets the arms go on.</div>}
    </div>
  );
}

function ClearanceFigure({ store }: { store: Store }) {
  use_store(store, 'live');
  const nearest = store.clearance.reduce<Store['clearance'][number] | null>((a, b) => (a && a.m <= b.m ? a : b), null);
  if (!nearest) return null;
  const limit_m = store.cell?.clearance_m ?? 0;
  const level = nearest.m < limit_m ? 'low' : nearest.m < 3 * limit_m ? 'near' : '';
  return (
    <div class={`clearance ${level}`} title="The smallest clearance that the monitor measures now">
      <span class="dim">{clearance_in_words(nearest)}</span> <b class="mono">{millimetres(nearest.m)}</b>
      <div class="small dim">{nearest.links[0]} – {nearest.links[1]}</div>
    </div>
  );
}
