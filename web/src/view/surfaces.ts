// Loads mesh files (STL, OBJ and COLLADA) from the server. Each file is loaded once.
//
// Materials and textures are not loaded. Points are in the frame of the file, in meters. The up
// axis that a COLLADA file states is not applied, because the server ignores it too.

import * as THREE from 'three';
import { ColladaLoader } from 'three/addons/loaders/ColladaLoader.js';
import { OBJLoader } from 'three/addons/loaders/OBJLoader.js';
import { STLLoader } from 'three/addons/loaders/STLLoader.js';
import { mergeGeometries } from 'three/addons/utils/BufferGeometryUtils.js';
import { address_on_server } from '../server/api';
import { turned_inside_out } from './shapes';

/** Surfaces by the address of their mesh file. Null if the file cannot be read. */
export type Surfaces = ReadonlyMap<string, THREE.BufferGeometry | null>;
type FetchBytes = (address: string) => Promise<ArrayBuffer>;

export class SurfaceShelf {
  private readonly loading_ = new Map<string, Promise<THREE.BufferGeometry | null>>();

  constructor(private readonly fetch_: FetchBytes = fetch_bytes) {}

  /** Resolves when each file is read or has failed. Never rejects. */
  async load(addresses: readonly string[]): Promise<Surfaces> {
    const all = [...new Set(addresses)].map(async (address) => [address, await this.get(address)] as const);
    return new Map(await Promise.all(all));
  }

  private get(address: string): Promise<THREE.BufferGeometry | null> {
    let loading = this.loading_.get(address);
    if (!loading) {
      loading = this.read(address);
      this.loading_.set(address, loading);
    }
    return loading;
  }

  private async read(address: string): Promise<THREE.BufferGeometry | null> {
    try {
      return parse_surface(address, await this.fetch_(address));
    } catch (error) {
      console.warn(`mesh ${address} cannot be read:`, error);
      this.loading_.delete(address);  // forgets the failure, because a later try may succeed
      return null;
    }
  }
}

async function fetch_bytes(address: string): Promise<ArrayBuffer> {
  // Mesh addresses must be paths of this server.
  if (!/^\/api\//.test(address)) throw new Error('not an address of this server');
  const response = await fetch(address_on_server(address));
  if (!response.ok) throw new Error(`${response.status} ${response.statusText}`);
  return response.arrayBuffer();
}

/** Returns the triangles with positions and normals, without an index. Throws if there are none. */
export function parse_surface(name: string, bytes: ArrayBuffer): THREE.BufferGeometry {
  const geometries = flat(parse(name, bytes));
  const merged = geometries.length ? mergeGeometries(geometries) : null;
  if (!merged || merged.getAttribute('position').count < 3) throw new Error('holds no triangle');
  return merged;
}

function parse(name: string, bytes: ArrayBuffer): THREE.Object3D {
  const kind = /\.(stl|obj|dae)$/i.exec(name)?.[1]?.toLowerCase();
  if (kind === 'stl') return new THREE.Mesh(new STLLoader().parse(bytes));
  const text = () => new TextDecoder().decode(bytes);
  if (kind === 'obj') return new OBJLoader().parse(text());
  if (kind !== 'dae') throw new Error('is neither STL nor OBJ nor COLLADA');
  const quiet = new THREE.LoadingManager();
  quiet.setURLModifier(() => 'data:,');
  const document = new ColladaLoader(quiet).parse(text(), '');
  if (!document) throw new Error('is not a COLLADA document');
  const root = new THREE.Group();
  // Keeps the scale, which converts the file's unit to meters. Drops the rotation, which applies
  // the up axis.
  document.scene.quaternion.identity();
  root.add(document.scene);
  return root;
}

/** Returns all triangles below `root`, in its frame. */
function flat(root: THREE.Object3D): THREE.BufferGeometry[] {
  const found: THREE.BufferGeometry[] = [];
  root.updateMatrixWorld(true);
  root.traverse((node) => {
    if (!(node instanceof THREE.Mesh)) return;
    const source = node.geometry as THREE.BufferGeometry;
    const plain = source.index ? source.toNonIndexed() : source.clone();
    if (!plain.hasAttribute('normal')) plain.computeVertexNormals();
    for (const attribute of Object.keys(plain.attributes)) {
      if (attribute !== 'position' && attribute !== 'normal') plain.deleteAttribute(attribute);
    }
    plain.morphAttributes = {};
    plain.clearGroups();
    plain.applyMatrix4(node.matrixWorld);
    found.push(node.matrixWorld.determinant() < 0 ? turned_inside_out(plain) : plain);
  });
  return found;
}
