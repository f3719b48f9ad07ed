//! Polygons cut into triangles.

/// Adds the triangles of a polygon: four corners along the shorter diagonal, more by cutting off ears.
pub(super) fn triangles(vertices: &[[f64; 3]], polygon: &[u32], out: &mut Vec<[u32; 3]>) {
    match *polygon {
        [a, b, c] => out.push([a, b, c]),
        [a, b, c, d] => {
            let squared = |i: u32, j: u32| {
                let (p, q) = (vertices[i as usize], vertices[j as usize]);
                (0..3).map(|k| (p[k] - q[k]) * (p[k] - q[k])).sum::<f64>()
            };
            match squared(a, c) < squared(b, d) {
                true => out.extend([[a, b, c], [a, c, d]]),
                false => out.extend([[a, b, d], [b, c, d]]),
            }
        }
        [] | [_] | [_, _] => {}
        _ => cut_ears(vertices, polygon, out),
    }
}

/// Ear clipping in the coordinate plane that sees most of the polygon.
fn cut_ears(vertices: &[[f64; 3]], polygon: &[u32], out: &mut Vec<[u32; 3]>) {
    let point = |v: u32| vertices[v as usize];
    // Newell's normal.
    let mut normal = [0.0; 3];
    for (i, &v) in polygon.iter().enumerate() {
        let (p, q) = (point(v), point(polygon[(i + 1) % polygon.len()]));
        for k in 0..3 {
            let (a, b) = ((k + 1) % 3, (k + 2) % 3);
            normal[k] += (p[a] - q[a]) * (p[b] + q[b]);
        }
    }
    let drop = (0..3).max_by(|&i, &j| normal[i].abs().total_cmp(&normal[j].abs())).unwrap_or(2);
    let (x, y, sign) = ((drop + 1) % 3, (drop + 2) % 3, normal[drop].signum());
    let area = |p: [f64; 3], q: [f64; 3], r: [f64; 3]| {
        sign * ((q[x] - p[x]) * (r[y] - p[y]) - (q[y] - p[y]) * (r[x] - p[x]))
    };
    let mut rest = polygon.to_vec();
    while rest.len() > 3 {
        let n = rest.len();
        let is_ear = |i: usize| {
            let (a, b, c) = (point(rest[i]), point(rest[(i + 1) % n]), point(rest[(i + 2) % n]));
            let inside = |p| area(a, b, p) > 0.0 && area(b, c, p) > 0.0 && area(c, a, p) > 0.0;
            area(a, b, c) > 0.0 && (3..n).all(|k| !inside(point(rest[(i + k) % n])))
        };
        // Without an ear the polygon crosses itself: any corner goes.
        let i = (0..n).find(|&i| is_ear(i)).unwrap_or(0);
        out.push([rest[i], rest[(i + 1) % n], rest[(i + 2) % n]]);
        rest.remove((i + 1) % n);
    }
    if let [a, b, c] = rest[..] {
        out.push([a, b, c]);
    }
}
