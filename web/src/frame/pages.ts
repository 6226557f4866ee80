// The pages of the navigation, with their keys. Less used pages are in the menu More.

import type { Place } from '../route/address';
import type { App } from '../state/app';
import { kText } from '../strings';

export interface Page { place(app: App): Place; title: string; key: string; test: string; more: boolean }

const plain = (page: 'cell' | 'new' | 'history' | 'recordings' | 'policies' | 'alerts' | 'recovery' | 'settings' | 'io') => (): Place => ({ page });

/** Returns the place of the open diagram, else of the diagram of the first two arms. */
function diagram({ router, store }: App): Place {
  const here = router.place;
  if (here.page === 'pair') return here;
  const [a = '', b = a] = [...store.arms.keys()];
  return { page: 'pair', a, b };
}

export const kPages: readonly Page[] = [
  { place: plain('cell'), title: kText.page.cell, key: 'c', test: 'go-cell', more: false },
  { place: plain('new'), title: kText.page.new, key: 'n', test: 'new-job', more: false },
  { place: () => ({ page: 'scene', name: null }), title: kText.page.scene, key: 'o', test: 'go-scene', more: false },
  { place: diagram, title: kText.page.diagram, key: 'd', test: 'go-diagram', more: false },
  { place: plain('history'), title: kText.page.history, key: 'h', test: 'go-history', more: false },
  { place: plain('recordings'), title: kText.page.recordings, key: 'r', test: 'go-recordings', more: true },
  { place: plain('io'), title: kText.page.io, key: 'i', test: 'go-io', more: true },
  { place: plain('policies'), title: kText.page.policies, key: 'p', test: 'go-compare', more: true },
  { place: plain('alerts'), title: kText.page.alerts, key: 'a', test: 'go-alerts', more: true },
  { place: plain('recovery'), title: kText.page.recovery, key: 'v', test: 'go-recovery', more: true },
  { place: plain('settings'), title: kText.page.settings, key: ',', test: 'go-settings', more: true },
];

export const kPageOfKey: ReadonlyMap<string, Page> = new Map(kPages.map((page) => [page.key, page]));
