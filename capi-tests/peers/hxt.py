#!/usr/bin/env python3
"""Fills a surface with HXT, Gmsh's algorithm 10, on one thread: the peer of `quality_figures.py --hxt`.

  python3 capi-tests/peers/hxt.py START.mesh MESH.mesh [SIZE]

Needs the Python package gmsh. The start is any mesh of the surface, in MEDIT's format: the faces on the boundary and between different
references are what is kept, so that nothing has to be guessed about insides. They become discrete surfaces of Gmsh, one for each pair of
regions; sizes come from them, or there is one. Gmsh's optimisation is on, as it is by default.
"""
import sys

import gmsh

OUTWARD = [(1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1)]


def read(path):
    """The points of a mesh, and its tetrahedra with their references."""
    words = open(path).read().split()

    def rows(keyword, width):
        start = words.index(keyword) + 2
        count = int(words[start - 1])
        return [words[start + width * i:start + width * (i + 1)] for i in range(count)]

    xyz = [float(x) for row in rows("Vertices", 4) for x in row[:3]]
    tets = [[int(word) for word in row] for row in rows("Tetrahedra", 5)]
    return xyz, tets


def surfaces(tets):
    """The corners of the triangles between regions, by the pair of these; 0 is outside. They look from the second to the first."""
    sides = {}
    for *corners, region in tets:
        for face in OUTWARD:
            face = [corners[i] for i in face]
            sides.setdefault(tuple(sorted(face)), []).append((region, face))
    found = {}
    for there in sides.values():
        regions = [region for region, _ in there]
        if len(there) == 1:
            found.setdefault((0, regions[0]), []).extend(there[0][1])
        elif regions[0] != regions[1]:
            found.setdefault((min(regions), max(regions)), []).extend(max(there)[1])
    return found


def main():
    start, output = sys.argv[1:3]
    size = float(sys.argv[3]) if len(sys.argv) > 3 else None
    xyz, tets = read(start)
    gmsh.initialize(["hxt", "-nopopup"], readConfigFiles=False)
    set_number = gmsh.option.setNumber
    set_number("General.Verbosity", 1)
    set_number("General.NumThreads", 1)
    set_number("Mesh.Algorithm3D", 10)
    if size is not None:
        set_number("Mesh.MeshSizeExtendFromBoundary", 0)
        set_number("Mesh.MeshSizeMin", size)
        set_number("Mesh.MeshSizeMax", size)
    gmsh.model.add("surface")
    bounds = {}
    known = set()
    for regions, corners in sorted(surfaces(tets).items()):
        entity = gmsh.model.addDiscreteEntity(2)
        # A point is given once, with the first surface that has it.
        new = sorted(set(corners) - known)
        known.update(new)
        gmsh.model.mesh.addNodes(2, entity, new, [x for v in new for x in xyz[3 * v - 3:3 * v]])
        gmsh.model.mesh.addElementsByType(entity, 2, [], corners)
        for region in regions:
            bounds.setdefault(region, []).append(entity)
    for region, entities in sorted(bounds.items()):
        if region != 0:
            gmsh.model.geo.addVolume([gmsh.model.geo.addSurfaceLoop(entities)])
    gmsh.model.geo.synchronize()
    gmsh.model.mesh.generate(3)
    set_number("Mesh.SaveAll", 1)
    gmsh.write(output)
    gmsh.finalize()


if __name__ == "__main__":
    main()
