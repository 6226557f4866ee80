// The page's addresses: the part behind # names a page, a time and a camera, so that a shared link
// shows the same. Pure.
//
//   #/                      the cell
//   #/job/ID  #/arm/NAME    one job, one arm
//   #/pair/A/B              the diagram of two jobs or arms, A across and B up
//   #/scene  #/scene/NAME   the objects, one of them selected
//   #/new                   the New job page
//   #/io                    the inputs and outputs
//   #/history  #/settings  #/alerts  #/recovery  #/recordings  #/policies
//   ?t=12.5                 the cell time that all views show, in seconds
//   &run=7997886f           the server session of this time, by the beginning of its stream id
//   ?camera=x,y,z,x,y,z     the camera's position and target, in meters

import { shown_name } from '../names';
import { kText } from '../strings';

const kTitles = kText.page;

export type Place =
  | { page: 'cell' } | { page: 'new' } | { page: 'history' } | { page: 'settings' }
  | { page: 'alerts' } | { page: 'recovery' } | { page: 'recordings' } | { page: 'policies' } | { page: 'io' }
  | { page: 'job'; id: string } | { page: 'arm'; name: string }
  | { page: 'pair'; a: string; b: string }
  | { page: 'scene'; name: string | null }
  | { page: 'unknown'; path: string };

const kPlain = ['new', 'history', 'settings', 'alerts', 'recovery', 'recordings', 'policies', 'io'] as const;

/** x, y, z of the camera's position, then of its target, in meters in the world frame. */
export type Camera = readonly [number, number, number, number, number, number];

/**
 * `t_s` is the shown cell time; null means now. `run` is the server session of `t_s`; null means
 * the present session.
 */
export interface Address { place: Place; t_s: number | null; run: string | null; camera: Camera | null }

export const kHome: Address = { place: { page: 'cell' }, t_s: null, run: null, camera: null };

export function parse_address(hash: string): Address {
  const [path = '', query = ''] = hash.replace(/^#/, '').split('?', 2);
  const asked = new URLSearchParams(query);
  const t_s = parse_time(asked.get('t'));
  return { place: parse_place(path), t_s, run: t_s === null ? null : parse_run(asked.get('run')), camera: parse_camera(asked.get('camera')) };
}

function parse_place(path: string): Place {
  const parts = path.split('/').filter((part) => part !== '').map(decoded);
  const [page, first, second] = parts;
  if (page === undefined) return { page: 'cell' };
  if (page === 'job' && first !== undefined && parts.length === 2) return { page, id: first };
  if (page === 'arm' && first !== undefined && parts.length === 2) return { page, name: first };
  if (page === 'pair' && first !== undefined && second !== undefined && parts.length === 3) return { page, a: first, b: second };
  if (page === 'scene' && parts.length <= 2) return { page, name: first ?? null };
  const plain = kPlain.find((known) => known === page);
  if (plain && parts.length === 1) return { page: plain };
  return { page: 'unknown', path };
}

function decoded(part: string): string {
  try {
    return decodeURIComponent(part);
  } catch {
    return part;
  }
}

function parse_time(text: string | null): number | null {
  const t_s = text === null || text === '' ? NaN : Number(text);
  return Number.isFinite(t_s) && t_s >= 0 ? t_s : null;
}

function parse_run(text: string | null): string | null {
  return text !== null && /^[0-9a-f]{8}/i.test(text) ? text.slice(0, 8) : null;
}

const kLeast_m = 0.01;

function parse_camera(text: string | null): Camera | null {
  const [a, b, c, d, e, f, ...more] = (text ?? '').split(',').map((part) => (part === '' ? NaN : Number(part)));
  if (a === undefined || b === undefined || c === undefined || d === undefined || e === undefined || f === undefined) return null;
  const camera: Camera = [a, b, c, d, e, f];
  if (Math.hypot(a - d, b - e, c - f) < kLeast_m) return null;  // position and target coincide
  return more.length === 0 && camera.every((value) => Number.isFinite(value) && Math.abs(value) < 1000) ? camera : null;
}

export function address_text({ place, t_s, run, camera }: Address): string {
  const query = [
    ...(t_s === null ? [] : [`t=${Number(t_s.toFixed(2))}`]),
    ...(t_s === null || run === null ? [] : [`run=${run}`]),
    ...(camera === null ? [] : [`camera=${camera.map((value) => Number(value.toFixed(3))).join(',')}`]),
  ].join('&');
  return `#${place_text(place)}${query === '' ? '' : `?${query}`}`;
}

function place_text(place: Place): string {
  const part = encodeURIComponent;
  switch (place.page) {
    case 'cell': return '/';
    case 'job': return `/job/${part(place.id)}`;
    case 'arm': return `/arm/${part(place.name)}`;
    case 'pair': return `/pair/${part(place.a)}/${part(place.b)}`;
    case 'scene': return place.name === null ? '/scene' : `/scene/${part(place.name)}`;
    case 'unknown': return place.path;
    default: return `/${place.page}`;
  }
}

/** Returns the title of the window. */
export function place_in_words(place: Place): string {
  switch (place.page) {
    case 'cell': return kTitles.cell;
    case 'job': return kTitles.job(shown_name(place.id));
    case 'arm': return kTitles.arm(shown_name(place.name));
    case 'pair': return kTitles.pair(shown_name(place.a), shown_name(place.b));
    case 'scene': return place.name === null ? kTitles.scene : kTitles.object(shown_name(place.name));
    case 'new': return kTitles.new;
    case 'history': return kTitles.history;
    case 'settings': return kTitles.settings;
    case 'alerts': return kTitles.alerts;
    case 'recovery': return kTitles.recovery;
    case 'recordings': return kTitles.recordings;
    case 'policies': return kTitles.policies;
    case 'io': return kTitles.io;
    case 'unknown': return kText.frame.no_page;
  }
}
