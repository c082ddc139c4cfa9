//! Leaving out some of many.

/// The values but for those at ascending positions.
pub(in crate::fit) fn without<T: Copy>(
    values: &[T],
    left_out: impl IntoIterator<Item = usize>,
) -> Vec<T> {
    let mut left_out = left_out.into_iter().peekable();
    let kept = values.iter().enumerate();
    let kept = kept.filter(|(at, _)| left_out.next_if_eq(at).is_none());
    kept.map(|(_, value)| *value).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_at_the_positions_are_left_out() {
        assert_eq!(without(&[5, 6, 7, 8], [0, 2]), [6, 8]);
        assert_eq!(without(&[5, 6], []), [5, 6]);
        assert_eq!(without(&[5, 6], [0, 1]), [0; 0]);
    }
}
