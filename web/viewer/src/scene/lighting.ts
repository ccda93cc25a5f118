import { Color, DirectionalLight, HemisphereLight, Object3D } from 'three';

/**
 * Lights fixed to the camera: a warm key light from the upper left, a cool fill light, and two rim
 * lights from behind.
 */
export function studioLights(): Object3D {
  const lights = new Object3D();
  lights.add(light('#fff3e2', 3.3, -3, 4, 4));
  lights.add(light('#b9ccf5', 0.8, 5, -1, 3));
  lights.add(light('#ffd9b0', 1.1, 4, 3, -5));
  lights.add(light('#8fb4ff', 0.9, -5, -2, -4));
  const sky = new HemisphereLight('#d5deec', '#4a3d33', 0.9);
  lights.add(sky);
  return lights;
}

function light(color: string, intensity: number, x: number, y: number, z: number): Object3D {
  const rig = new Object3D();
  const lamp = new DirectionalLight(new Color(color), intensity);
  lamp.position.set(x, y, z);
  rig.add(lamp, lamp.target); // the target turns with the rig
  return rig;
}
