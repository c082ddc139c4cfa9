//! Tables that are made once in a process, and kept.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

/// Tables by what they are made for.
pub(super) struct Kept<K, T>(Mutex<BTreeMap<K, Arc<T>>>);

impl<K: Ord, T> Kept<K, T> {
    pub(super) const fn new() -> Self {
        Self(Mutex::new(BTreeMap::new()))
    }

    /// The table for `key`. Of threads that make it at once, all get that of the first.
    pub(super) fn get(&self, key: K, make: impl FnOnce() -> T) -> Arc<T> {
        let kept = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let known = kept().get(&key).cloned();
        known.unwrap_or_else(|| {
            let made = Arc::new(make());
            Arc::clone(kept().entry(key).or_insert(made))
        })
    }
}
