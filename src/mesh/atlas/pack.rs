//! Rectangles into one square: shelves of falling height.

/// Widest and tallest an atlas may be, px.
pub const LARGEST: usize = 8192;

/// Where each rectangle lies, left and top, and the size of the whole; `None` where they do not
/// fit into [`LARGEST`] × [`LARGEST`].
pub fn shelves(sizes: &[[usize; 2]]) -> Option<(Vec<[usize; 2]>, [usize; 2])> {
    let widest = sizes.iter().map(|size| size[0]).max().unwrap_or(0);
    let area: f64 = sizes.iter().map(|size| size[0] as f64 * size[1] as f64).sum();
    let mut order: Vec<usize> = (0..sizes.len()).collect();
    order.sort_by_key(|&n| (std::cmp::Reverse(sizes[n][1]), std::cmp::Reverse(sizes[n][0]), n));
    let mut best: Option<(Vec<[usize; 2]>, [usize; 2])> = None;
    // A few widths about the square root of the area; the least picture wins, the squarer of
    // equals.
    for share in [0.8, 0.9, 1.0, 1.1, 1.25, 1.5, 1.8, 2.2, 2.8] {
        let width = ((area.sqrt() * share) as usize).max(widest).min(LARGEST);
        let Some(packed) = at_width(sizes, &order, width) else { continue };
        let cost = |size: [usize; 2]| (size[0] * size[1], size[0].abs_diff(size[1]));
        if best.as_ref().is_none_or(|(_, size)| cost(packed.1) < cost(*size)) {
            best = Some(packed);
        }
    }
    best
}

fn at_width(
    sizes: &[[usize; 2]],
    order: &[usize],
    width: usize,
) -> Option<(Vec<[usize; 2]>, [usize; 2])> {
    let mut places = vec![[0, 0]; sizes.len()];
    let (mut left, mut top, mut shelf, mut used) = (0, 0, 0, 0);
    for &n in order {
        let [w, h] = sizes[n];
        if w > width {
            return None;
        }
        if left + w > width {
            top += shelf;
            (left, shelf) = (0, 0);
        }
        places[n] = [left, top];
        left += w;
        shelf = shelf.max(h);
        used = used.max(left);
    }
    let height = top + shelf;
    (height <= LARGEST).then_some((places, [used, height]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_overlaps_and_all_lies_inside() {
        let sizes: Vec<[usize; 2]> =
            (0..40).map(|n| [20 + n * 37 % 300, 10 + n * 53 % 400]).collect();
        let (places, [width, height]) = shelves(&sizes).unwrap();
        for (n, (a, s)) in places.iter().zip(&sizes).enumerate() {
            assert!(a[0] + s[0] <= width && a[1] + s[1] <= height);
            for (b, t) in places.iter().zip(&sizes).skip(n + 1) {
                let apart =
                    |axis: usize| a[axis] + s[axis] <= b[axis] || b[axis] + t[axis] <= a[axis];
                assert!(apart(0) || apart(1));
            }
        }
        let used: usize = sizes.iter().map(|s| s[0] * s[1]).sum();
        assert!(used * 10 > width * height * 6, "less than two fifths are wasted");
    }

    #[test]
    fn what_cannot_fit_is_said() {
        assert_eq!(shelves(&[[8193, 4]]), None);
        assert_eq!(shelves(&[[4096, 4096]; 5]), None);
        assert!(shelves(&[[4096, 4096]; 4]).is_some());
        assert_eq!(shelves(&[]), Some((vec![], [0, 0])));
    }
}
