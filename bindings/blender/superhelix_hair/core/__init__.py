"""Hair in a timeline, without Blender: the bpy layer reads a scene into these types and writes positions back.

settings.py  what the user chooses, checked
rest.py      the scene as drawn: curves, what carries their roots, colliders; and the inputs of a frame
space.py     matrices to frames, units, attachment of roots to a surface
rig.py       a solver built from a rest, and its points
store.py     frames and snapshots on disk
session.py   frames in order: advance, seek, resume
pose.py      drag and brush the drawn hair
growth.py    render hair that follows the simulated curves

All lengths are metres, world space, unless a name says otherwise.
"""
