# SPDX-License-Identifier: MIT
"""The Python binding against the compiler's layout, exact limits, and what errors must do."""
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

TREE = pathlib.Path(__file__).resolve().parents[2]
SAMPLES = TREE / "samples" / "python"
sys.dont_write_bytecode = True
sys.path.insert(0, str(SAMPLES))
import numpy as np

import welkin as wlk


class Layout(unittest.TestCase):
    def test_is_what_the_c_compiler_made(self):
        text = (TREE / "tests" / "abi" / "layout_test.c").read_text(encoding="utf-8")
        sizes = re.findall(r"^SIZE\((Wlk\w+), (\d+)\)", text, re.M)
        fields = re.findall(r"^AT\((Wlk\w+), (\w+), (\d+)\)", text, re.M)
        known = {name for name in wlk.ffi.list_types()[0]}
        compared = 0
        for name, size in sizes:
            if name in known:  # those with Vulkan's types are not bound
                self.assertEqual(wlk.ffi.sizeof(name), int(size), name)
                compared += 1
        for name, field, offset in fields:
            if name in known:
                self.assertEqual(wlk.ffi.offsetof(name, field), int(offset), f"{name}::{field}")
                compared += 1
        self.assertGreater(compared, 200)

    def test_every_structure_with_a_head_is_initialised(self):
        started = 0
        for name in wlk.ffi.list_types()[0]:
            if name.startswith("Wlk") and wlk.ffi.typeof(name).kind == "struct" and \
                    "structSize" in dict(wlk.ffi.typeof(name).fields):
                self.assertEqual(wlk.make(name).structSize, wlk.ffi.sizeof(name))
                started += 1
        self.assertGreater(started, 25)

    def test_every_function_of_the_headers_is_exported(self):
        # From the folder, not from a list that a new header would be missing in.
        headers = [file for file in (TREE / "include/welkin").glob("*.h")
                   if file.name != "welkin_vulkan.h"]
        text = "".join(file.read_text(encoding="utf-8") for file in headers)
        functions = re.findall(r"WLK_API\b[^;{]*?\b(wlk\w+)\s*\(", text)
        self.assertGreater(len(functions), 60)
        for function in functions:
            self.assertTrue(callable(getattr(wlk.lib, function)), function)


class Queries(unittest.TestCase):
    def setUp(self):
        self.context = wlk.Context()
        self.addCleanup(self.context.close)

    def test_phase_functions_integrate_to_one(self):
        medium = self.context.create_medium(wlk.make("WlkMediumInfo", diameter_um=10))
        # Gauss-Legendre in panels that are finer towards the forward peak.
        edges = np.concatenate([[0], np.geomspace(1e-4, np.pi, 400)])
        node, weight = np.polynomial.legendre.leggauss(8)
        half = np.diff(edges)[:, None] / 2
        angle = edges[:-1, None] + half * (node + 1)
        ring = (2 * np.pi * np.sin(angle) * half * weight).ravel()
        total = ring @ self.context.phase(medium, angle.ravel())
        np.testing.assert_allclose(total, 1, rtol=1e-3)  # of the table's interpolation

    def test_vertical_transmittance_is_that_of_the_air_column(self):
        sky = wlk.make("WlkSky")
        self.context.SetSky(sky)
        _, transmittance = self.context.sky((0, 0, 0), np.array([0.0, 1.0, 0.0]))
        column = np.array(list(sky.rayleighScattering)) * sky.scaleHeight
        np.testing.assert_allclose(-np.log(transmittance), column, rtol=2e-3)  # stated: 0.2 %

    def test_shapes_follow_the_arrays_given(self):
        self.context.SetSky(wlk.make("WlkSky"))
        self.context.set_lights(wlk.make("WlkLight", direction=(0, 1, 0)))
        directions = np.tile([0.0, 1.0, 0.0], (2, 3, 1))
        radiance, transmittance = self.context.sky((0, 2, 0), directions, length=1e4)
        self.assertEqual(radiance.shape, (2, 3, 3))
        self.assertEqual(transmittance.shape, (2, 3, 3))
        self.assertTrue(np.all(radiance == radiance[0, 0]) and np.all(radiance > 0))
        self.assertEqual(self.context.sky_map((0, 2, 0), size=8).shape, (8, 8, 3))

    def test_draws_follow_the_phase_function(self):
        medium = self.context.create_medium(
            wlk.make("WlkMediumInfo", particle=wlk.lib.WLK_PARTICLE_HENYEY_GREENSTEIN,
                     asymmetry=0.5))
        random = (np.arange(4000) + 0.5) / 4000
        angle, density = self.context.sample_phase(medium, random)
        self.assertAlmostEqual(np.cos(angle).mean(), 0.5, delta=1e-3)
        np.testing.assert_allclose(density, self.context.phase(medium, angle)[:, 1], rtol=1e-6)


class Mistakes(unittest.TestCase):
    def setUp(self):
        self.context = wlk.Context()
        self.addCleanup(self.context.close)

    def test_errors_name_the_field(self):
        with self.assertRaises(wlk.Error) as caught:
            self.context.SetSky(wlk.make("WlkSky", scaleHeight=-1))
        self.assertEqual(caught.exception.field, "scaleHeight")
        self.assertEqual(caught.exception.result, wlk.lib.WLK_ERROR_INVALID_ARGUMENT)

    def test_misspelled_fields_and_functions_are_refused(self):
        with self.assertRaises(AttributeError):
            wlk.make("WlkSky", scaleHight=1)
        with self.assertRaises(AttributeError):
            self.context.SetSkye(wlk.ffi.NULL)

    def test_arrays_of_another_length_are_refused(self):
        with self.assertRaises(ValueError):
            wlk.make("WlkLight", irradiance=(1, 1))

    def test_volumes_need_a_device(self):
        medium = self.context.create_medium(wlk.make("WlkMediumInfo"))
        with self.assertRaises(wlk.Error) as caught:
            self.context.create_volume(np.ones((2, 2, 2)), medium, 1, np.eye(3, 4))
        self.assertEqual(caught.exception.name, "WLK_ERROR_WRONG_STATE")


class Pictures(unittest.TestCase):
    def test_box_without_light_attenuates_by_its_optical_depth(self):
        with wlk.Context(headless=True) as context:
            medium = context.create_medium(wlk.make("WlkMediumInfo"))
            box = np.eye(3, 4) * 10
            box[:, 3] = -5, -5, -20
            context.create_volume(np.ones((4, 4, 4), np.float32), medium, 0.1, box)
            camera = wlk.make("WlkCamera", position=(0, 0, 0))
            color = np.full((16, 16, 4), 2, np.float32)
            picture = context.render(16, 16, camera, color=color)
        middle = picture[7:9, 7:9, :3]
        # Rays of the middle pixels, 2.9 degrees off the axis, are 0.13 % longer than the box is
        # deep; half floats of density and picture add 0.05 % each.
        np.testing.assert_allclose(middle, 2 * np.exp(-1), rtol=2 * 0.0023)
        np.testing.assert_allclose(picture[0, 0, :3], 2, rtol=1e-6)

    def test_wrong_shapes_are_refused(self):
        with wlk.Context(headless=True) as context:
            with self.assertRaises(ValueError):
                context.render(16, 8, color=np.zeros((16, 8, 4)))


class Example(unittest.TestCase):
    def test_writes_its_figures(self):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([sys.executable, str(SAMPLES / "sky_and_phase.py"), folder],
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stdout.count("direct"), 3)
            for name in ("phase.png", "sky.png"):
                data = (pathlib.Path(folder) / name).read_bytes()
                self.assertTrue(data.startswith(b"\x89PNG") and len(data) > 20000, name)


if __name__ == "__main__":
    unittest.main(verbosity=2)
