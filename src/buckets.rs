//! Numbers sorted into buckets, in their order in each.

/// The numbers of things, bucket by bucket.
pub(crate) struct Buckets {
    members: Vec<u32>,
    /// Bucket b holds members `starts[b]..starts[b + 1]`.
    starts: Vec<usize>,
}

impl Buckets {
    /// So many buckets; `bucket_of`: that of each thing, in their order.
    pub(crate) fn new(count: usize, bucket_of: &[u32]) -> Self {
        let mut starts = vec![0; count + 1];
        for &bucket in bucket_of {
            starts[bucket as usize + 1] += 1;
        }
        for bucket in 0..count {
            starts[bucket + 1] += starts[bucket];
        }
        let mut members = vec![0; bucket_of.len()];
        let mut next = starts.clone();
        for (index, &bucket) in (0..).zip(bucket_of) {
            members[next[bucket as usize]] = index;
            next[bucket as usize] += 1;
        }
        Self { members, starts }
    }

    /// What a bucket holds.
    pub(crate) fn get(&self, bucket: usize) -> &[u32] {
        &self.members[self.starts[bucket]..self.starts[bucket + 1]]
    }

    /// What each bucket holds.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &[u32]> + Clone {
        let pairs = self.starts.windows(2);
        pairs.map(|pair| &self.members[pair[0]..pair[1]])
    }

    /// All numbers, bucket by bucket.
    pub(crate) fn members(&self) -> &[u32] {
        &self.members
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_is_in_its_bucket_in_order() {
        let buckets = Buckets::new(4, &[2, 0, 2, 3, 0]);
        assert_eq!(buckets.get(2), [0, 2]);
        let all: Vec<_> = buckets.iter().collect();
        assert_eq!(all, [&[1, 4][..], &[], &[0, 2], &[3]]);
        assert_eq!(buckets.members(), [1, 4, 0, 2, 3]);
    }
}
