import bottle from '@examples/bottle.grasp.json';
import boxHardJaws from '@examples/box-hard-jaws.grasp.json';
import boxSoftJaws from '@examples/box-soft-jaws.grasp.json';
import boxThreeFingers from '@examples/box-three-fingers.grasp.json';
import bracket from '@examples/bracket-parallel-jaw.mesh.json';
import cylinder from '@examples/cylinder-three-fingers.grasp.json';
import drill from '@examples/drill-three-fingers.mesh.json';
import hexagon from '@examples/hexagon-three-fingers.grasp.json';
import lPart from '@examples/l-part.grasp.json';
import mug from '@examples/mug-parallel-jaw.mesh.json';
import tray from '@examples/tray.grasp.json';
import { unfolded } from './fold';
import type { Grasp } from './grasp';
import type { Triangles } from './mesh';
import { paperDisk } from './paper';

export interface Preset {
  label: string;
  grasp: Grasp;
  /** What it looks like, if its shape is a mesh. */
  mesh?: Triangles;
}

const least = 1 / Math.sqrt(3);
const named = (grasp: Grasp): Preset => ({ label: grasp.name ?? 'example', grasp });

/** What to begin with: the figures of the paper, then the examples. */
export const presets: { group: string; grasps: Preset[] }[] = [
  {
    group: 'The paper',
    grasps: (
      [
        ['Fig. 3(a): φ = 60°, μ = √3', 60, Math.sqrt(3), Math.sqrt(3)],
        ['Fig. 3(b), 4(b): φ = 60°, μ = 1', 60, 1, 1],
        ['Fig. 3(c): φ = 60°, μ = 1/√3 + 0.01', 60, least + 0.01, least + 0.01],
        ['Fig. 4(a): φ = 75°, μ = 1', 75, 1, 1],
        ['Fig. 4(c): φ = 45°, μ = 1', 45, 1, 1],
        ['Fig. 4(c) with μ = 1.01', 45, 1.01, 1.01],
        ['Fig. 6: φ = 75°, μ = 1 and 1/√3', 75, 1, least],
      ] as const
    ).map(([label, phi, mu1, mu2]) => ({ label, grasp: paperDisk(label, phi, mu1, mu2) })),
  },
  {
    group: 'In the plane',
    grasps: [lPart, hexagon].map(named),
  },
  {
    group: 'In space',
    grasps: [
      ...[cylinder, boxThreeFingers, boxHardJaws, boxSoftJaws, bottle, tray].map(named),
      ...[bracket, mug, drill].map(({ grasp, mesh }) => ({ ...named(grasp), mesh: unfolded(mesh) })),
    ],
  },
];
export const first = 'Fig. 6: φ = 75°, μ = 1 and 1/√3';
