"""What a sample saw: surface properties at the first and second hit, NaN where nothing was hit."""
import drjit as dr
import mitsuba as mi


def _where(valid, vector):
    return dr.select(valid, vector, dr.nan)


def facing_normal(hit, ray):
    """Shading normal, on the side of the surface that the ray comes from."""
    geometric = dr.select(dr.dot(hit.n, ray.d) > 0, -hit.n, hit.n)
    shading = mi.Vector3f(hit.sh_frame.n)
    return dr.select(dr.dot(shading, geometric) < 0, -shading, shading)


def first_hits(hit, ray):
    """Slots of the first hit. Albedo is clipped to [0, 1]: rough conductors report up to 27."""
    valid = hit.is_valid()
    albedo = hit.bsdf(ray).eval_diffuse_reflectance(hit, valid)
    albedo = mi.Color3f(albedo) if dr.size_v(albedo) == 3 else mi.Color3f(dr.mean(albedo))
    return {"N": _where(valid, facing_normal(hit, ray)), "P": _where(valid, hit.p), "albedo": _where(valid, dr.clip(albedo, 0, 1)),
            "uv": _where(valid, hit.uv), "hit": dr.select(valid, mi.Float(1), 0)}


def second_hits(scene, hit, ray, lobe, direction):
    """Slots of the second hit, along the ray that the integrator chooses with these numbers."""
    valid = hit.is_valid()
    sample, weight = hit.bsdf(ray).sample(mi.BSDFContext(), hit, lobe, direction, valid)
    there = valid & (dr.max(mi.unpolarized_spectrum(weight)) > 0)
    onward = hit.spawn_ray(hit.to_world(sample.wo))
    second = scene.ray_intersect(onward, there)
    there &= second.is_valid()
    return {"N2": _where(there, facing_normal(second, onward)), "P2": _where(there, second.p)}
