"""The scene for Mitsuba 3: its LLVM variant, `path`, `multijitter`."""

import time

import numpy
from scene import COLOR, DEPTH, FLOOR, GOLD, POSITION, TARGET, YFOV, geometry, sky

PACKAGES = ("mitsuba==3.9.1", "drjit==1.5.0")


def rgb(value):
    return {"type": "rgb", "value": list(value)}


BALLS = {
    "gold, roughness .3": {"type": "roughconductor", "distribution": "ggx", "alpha": 0.3,
                           "eta": rgb(GOLD["eta"]), "k": rgb(GOLD["k"])},
    "plastic, roughness .3": {"type": "principled", "base_color": rgb(COLOR), "roughness": 0.3 ** 0.5,
                              "specular": 0.5},
    "glass, smooth": {"type": "dielectric", "int_ior": 1.5, "ext_ior": 1.0},
    "glass, roughness .2": {"type": "roughdielectric", "distribution": "ggx", "alpha": 0.2, "int_ior": 1.5,
                            "ext_ior": 1.0},
}


class Peer:
    def __init__(self, subject, _folder, asked):
        import mitsuba

        mitsuba.set_variant("llvm_ad_rgb")
        self.mi = mitsuba
        u_of_theirs = numpy.roll(sky(), sky().shape[1] // 2, axis=1)  # u = 0 is where ours has 1/2.
        diffuse = {"type": "diffuse", "reflectance": rgb([FLOOR] * 3)}
        self.scene = mitsuba.load_dict({
            "type": "scene", "integrator": {"type": "path", "max_depth": DEPTH + 1},
            **{name: self.mesh(name, rows, BALLS[subject] if name == "ball" else diffuse)
               for name, rows in geometry().items()},
            "sky": {"type": "envmap", "bitmap": mitsuba.Bitmap(numpy.ascontiguousarray(u_of_theirs))},
            "sensor": {"type": "perspective", "fov": float(numpy.degrees(YFOV)), "fov_axis": "y",
                       "to_world": mitsuba.ScalarTransform4f().look_at(POSITION, TARGET, [0, 1, 0]),
                       "sampler": {"type": "multijitter", "sample_count": asked.spp},
                       "film": {"type": "hdrfilm", "width": asked.size, "height": asked.size,
                                "rfilter": {"type": "box"}}}})
        self.run(1000, asked.spp)  # Kernels are compiled from now on.

    def mesh(self, name, rows, bsdf):
        props = self.mi.Properties()
        props["mesh_bsdf"] = self.mi.load_dict(bsdf)
        positions, normals, triangles = rows
        made = self.mi.Mesh(name, len(positions), len(triangles), has_vertex_normals=True, props=props)
        parameters = self.mi.traverse(made)
        parameters["vertex_positions"] = self.mi.Float(numpy.ravel(numpy.float32(positions)))
        parameters["vertex_normals"] = self.mi.Float(numpy.ravel(numpy.float32(normals)))
        parameters["faces"] = self.mi.UInt32(numpy.ravel(numpy.uint32(triangles)))
        parameters.update()
        return made

    def run(self, seed, spp):
        """A picture, and the CPU time of this process in seconds."""
        begin = time.process_time()
        picture = numpy.array(self.mi.render(self.scene, spp=spp, seed=seed))
        return picture[..., :3], time.process_time() - begin
