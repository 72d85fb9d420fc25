"""Draws surfaces by VTK into an image in memory."""

import numpy as np
from PIL import Image
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  pylint: disable=unused-import

FINER = 2  # pixels of VTK along each side of a pixel of the image: smooth edges, in less time than by multisampling
BEHIND = 0.01  # a painted state is moved away so far, in halves of the picture's height, lest it meets another
BEFORE = 0.002  # lines are moved towards the viewer so far, lest surfaces on which they lie hide them
LIGHTS = (((-0.4, 0.7, 1.0), 0.72), ((0.8, -0.6, 0.7), 0.28))  # directions towards them in view axes, and intensities


class Window:
    """Draws Surfaces. It needs a virtual_display while it exists."""

    def __init__(self, surfaces, camera):
        """surfaces: drawn over one another; camera: a Camera"""
        self.camera, self.size = camera, camera.size
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(0)
        self.window.SetSize(FINER * self.size[0], FINER * self.size[1])
        self.renderer = vtkRenderer()
        self.renderer.SetBackground(1, 1, 1)
        self.renderer.AutomaticLightCreationOff()
        self._light()
        camera.place(self.renderer.GetActiveCamera())
        self.window.AddRenderer(self.renderer)
        self.sheets = [(each, [_Mesh(each, part, self.renderer) for part in _parts(each)]) for each in surfaces]

    def _light(self):
        for direction, intensity in LIGHTS:
            light = vtkLight()
            light.SetLightTypeToCameraLight()
            light.SetPosition(*direction)
            light.SetFocalPoint(0, 0, 0)
            light.SetIntensity(intensity)
            self.renderer.AddLight(light)

    def close(self):
        """Leaves the display, which must happen before it ends."""
        self.window.Finalize()

    def image(self, moments, moved=0.0):
        """A PIL image. moments: one for each of the surfaces; moved: as in Camera.seen"""
        for (surfaces, meshes), moment in zip(self.sheets, moments):
            points = np.nan_to_num(self.camera.seen(moment.points, moved), nan=0.0, posinf=0.0, neginf=0.0)
            points[:, 2] -= BEHIND if surfaces.paint else 0.0
            normals = np.nan_to_num(moment.normals @ self.camera.axes.T)
            for mesh in meshes:
                mesh.update(points, normals, moment.colours)
        self.window.Render()
        pixels = vtkUnsignedCharArray()
        width, height = self.window.GetSize()
        self.window.GetPixelData(0, 0, width - 1, height - 1, 1, pixels, 0)
        fine = Image.fromarray(np.ascontiguousarray(vtk_to_numpy(pixels).reshape(height, width, -1)[::-1, :, :3]))
        return fine.reduce(FINER)


def _parts(surfaces):
    """Cells that are drawn together: triangles that cover what is behind them, lines, and those that do not cover it."""
    yield surfaces.triangles[~surfaces.translucent], False
    yield surfaces.lines, False
    yield surfaces.triangles[surfaces.translucent], True


class _Mesh:
    """Some cells of surfaces with the points that they use."""

    def __init__(self, surfaces, part, renderer):
        cells, translucent = part
        self.used, numbers = np.unique(cells, return_inverse=True)
        if not len(cells):
            return
        numbers = np.column_stack([np.full(len(cells), cells.shape[1]), numbers.reshape(cells.shape)]).astype(np.int64)
        block = vtkCellArray()
        block.SetCells(len(cells), numpy_to_vtkIdTypeArray(numbers.ravel(), deep=True))
        self.data = vtkPolyData()
        self.data.SetPoints(vtkPoints())
        lines = cells.shape[1] == 2
        (self.data.SetLines if lines else self.data.SetPolys)(block)
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(self.data)
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.SetForceTranslucent(translucent)
        actor.SetForceOpaque(not translucent)
        look = actor.GetProperty()
        look.SetAmbient(1.0 if lines else 0.42)
        look.SetDiffuse(0.0 if lines else 0.78)
        look.SetSpecular(0.0 if lines else 0.12)
        look.SetSpecularPower(20)
        look.SetLineWidth(1.5 * FINER)
        look.SetBackfaceCulling(bool(surfaces.paint) and not lines)
        self.lines = lines
        renderer.AddActor(actor)

    def update(self, points, normals, colours):
        if not len(self.used):
            return
        place = points[self.used]
        if self.lines:
            place[:, 2] += BEFORE
        self.data.GetPoints().SetData(_array(place, np.float32))
        if not self.lines:
            self.data.GetPointData().SetNormals(_array(normals[self.used], np.float32))
        self.data.GetPointData().SetScalars(_array(colours[self.used], np.uint8))
        self.data.GetPoints().Modified()
        self.data.Modified()


def _array(values, kind):
    return numpy_to_vtk(np.ascontiguousarray(values, kind), deep=True)
