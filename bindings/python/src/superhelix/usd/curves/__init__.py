"""Curves of a prim: control vertices and primvars read, points on the curves evaluated."""
