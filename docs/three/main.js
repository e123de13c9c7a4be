/** The preset that the address names (#default), in motion. */
import * as THREE from "three";
import { Water } from "./water.js";

/** A running Seafoam server, as the address names it (?server=https://example.org/): by default that of this origin. */
const SERVER = new URL(new URLSearchParams(location.search).get("server") ?? "/", location.href);
const preset = location.hash.slice(1) || "default";

async function get(path) {
  const response = await fetch(new URL(path, SERVER));
  if (!response.ok) throw new Error(`${path}: ${response.status}`);
  return response.json();
}

const renderer = new THREE.WebGLRenderer({ antialias: false, depth: false });
renderer.setSize(innerWidth, innerHeight);
document.body.append(renderer.domElement);
const [plan, { scene, time }] = await Promise.all([get(`api/plans/${preset}`), get(`api/presets/${preset}`)]);
const water = await Water.load(renderer, plan, SERVER);
addEventListener("resize", () => renderer.setSize(innerWidth, innerHeight));
const start = performance.now();
renderer.setAnimationLoop((now) => water.draw({ time: time + (now - start) / 1000, camera: scene.camera }));
