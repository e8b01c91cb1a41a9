// One strand, held out level at its root, falls and swings for a second: examples_c/hello.c under node.
//   node examples_wasm/hello.mjs build/wasm/superhelix.wasm
import { readFile } from "node:fs/promises";
import { load } from "../bindings/wasm/superhelix.mjs";

const api = JSON.parse(await readFile(new URL("../bindings/api.json", import.meta.url)));
const shx = await load(await readFile(process.argv[2] ?? "build/wasm/superhelix.wasm"), api);

const solver = shx.made("shx_solver_create", 0); // all defaults: gravity points to -z

const strand = shx.filled("shx_strand_def");
strand.length = 0.2; // m
strand.element_count = 5; // helical elements
strand.air_drag = 5e-6; // kg/(m s)
const id = shx.struct("shx_strand_id");
shx.call("shx_solver_add_strands", solver, strand, strand.size, 1, id);

const length = shx.array(Float64Array, 1).byteOffset;
shx.view.setFloat64(length, 0.2, true);
const tip = shx.struct("shx_output");
tip.data = shx.allocate(24);
tip.count = 1;
tip.format = shx.constants.SHX_FORMAT_F64X3;
for (let frame = 0; frame < 60; frame++) {
  shx.call("shx_solver_step", solver, 1 / 60, 1, 0);
  shx.call("shx_solver_sample_at", solver, id.bits, length, 1, 0, tip, 0, 0);
  if (frame % 10 === 9) {
    const at = [0, 1, 2].map((axis) => shx.view.getFloat64(tip.data + 8 * axis, true).toFixed(4));
    console.log(`${((frame + 1) / 60).toFixed(3)} s: the tip is at (${at.join(", ")}) m`);
  }
}

shx.call("shx_solver_destroy", solver);
