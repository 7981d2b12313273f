"""Scenes of Blender made in code: a defocused one, a moving one, a pinhole; node materials, linked objects, lens shift, a focus object."""
import bpy


def _material(name, color, roughness, checker=False):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes = material.node_tree.nodes
    shader = nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value, shader.inputs["Roughness"].default_value = (*color, 1), roughness
    if checker:
        texture = nodes.new("ShaderNodeTexChecker")
        texture.inputs["Scale"].default_value = 24
        material.node_tree.links.new(nodes.new("ShaderNodeTexCoord").outputs["UV"], texture.inputs["Vector"])
        material.node_tree.links.new(texture.outputs["Color"], shader.inputs["Base Color"])
    return material


def _objects(scene):
    bpy.ops.mesh.primitive_plane_add(size=30)
    bpy.context.object.data.materials.append(_material("floor", (0.5, 0.5, 0.5), 0.7, checker=True))
    bpy.ops.mesh.primitive_uv_sphere_add(location=(-1.6, 0, 1), segments=32, ring_count=16)
    ball = bpy.context.object
    bpy.ops.object.shade_smooth()
    ball.data.materials.append(_material("ball", (0.8, 0.2, 0.1), 0.25))
    for place in ((1.2, 2.5, 1), (0.6, -2.2, 0.6)):  # linked: they share the ball's mesh
        linked = ball.copy()
        linked.location = place
        linked.scale = [place[2]] * 3
        scene.collection.objects.link(linked)
    bpy.ops.object.light_add(type="AREA", location=(3, -3, 6))
    light = bpy.context.object
    light.data.energy, light.data.size = 900, 2.5
    light.rotation_euler = (0.6, 0.35, 0)
    return ball


def _camera(scene):
    bpy.ops.object.camera_add(location=(0, -9, 2.2), rotation=(1.42, 0, 0))
    camera = bpy.context.object
    camera.data.lens, camera.data.shift_x, camera.data.shift_y = 40, 0.06, -0.04
    scene.camera = camera
    return camera


def make(kind, size=(96, 54)):
    """An empty file with the scene defocus, motion or pinhole."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine, scene.render.threads_mode, scene.render.threads = "CYCLES", "FIXED", 2
    scene.render.resolution_x, scene.render.resolution_y, scene.cycles.seed = *size, 5
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.15, 0.22, 0.35, 1)
    ball, camera = _objects(scene), _camera(scene)
    if kind == "defocus":
        camera.data.dof.use_dof, camera.data.dof.focus_object, camera.data.dof.aperture_fstop = True, ball, 0.08
        camera.scale = (1.5, 1.5, 1.5)
    if kind == "motion":
        scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 0.8
        scene.frame_set(3)
        for frame, x in ((1, -3.6), (5, 1.0)):
            ball.location.x = x
            ball.keyframe_insert("location", frame=frame)
        scene.frame_set(3)
    bpy.context.view_layer.update()
    return scene
