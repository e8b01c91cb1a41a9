"""One strand, held out level at its root, falls and swings for a second: examples_c/hello.c in Python."""

import superhelix as shx

with shx.Solver() as solver:  # all defaults: gravity points to -z
    [strand] = solver.add_strands(shx.StrandDefs(1, length=0.2, element_count=5, air_drag=5e-6))
    for frame in range(1, 61):
        solver.step(1 / 60)
        if frame % 10 == 0:
            x, y, z = solver.sample_at(strand, [0.2])[0]
            print(f"{frame / 60:.3f} s: the tip is at ({x:.4f}, {y:.4f}, {z:.4f}) m")
