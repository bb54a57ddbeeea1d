//! A column whose rows hold lists of different lengths.

use crate::each::set_length;

/// A list for each row, all of them in one array, so that a row without any entry needs no space in it.
#[derive(Clone, Debug, PartialEq)]
pub struct RowLists<T> {
    /// The end of each row's range; it begins where the previous row's ends.
    end: Vec<u32>,
    entry: Vec<T>,
}

impl<T> Default for RowLists<T> {
    fn default() -> Self {
        Self { end: Vec::new(), entry: Vec::new() }
    }
}

impl<T: Clone> RowLists<T> {
    /// A row's list; empty for a row that is not there.
    #[inline(always)]
    pub fn get(&self, row: usize) -> &[T] {
        let Some(&end) = self.end.get(row) else { return &[] };
        let start = if row == 0 { 0 } else { self.end[row - 1] };
        &self.entry[start as usize..end as usize]
    }

    /// So many rows with empty lists.
    pub fn start(&mut self, rows: usize) {
        self.entry.clear();
        self.end.clear();
        set_length(&mut self.end, rows, || 0);
    }

    /// Appends rows with empty lists up to so many rows.
    pub fn fill_to(&mut self, rows: usize) {
        self.end.resize(rows, self.entry.len() as u32);
    }

    /// Appends a row with this list.
    #[inline(always)]
    pub fn push(&mut self, list: &[T]) {
        if !list.is_empty() {
            self.entry.extend_from_slice(list);
        }
        self.end.push(self.entry.len() as u32);
    }

    /// Where each row's list ends.
    pub fn ends(&self) -> &[u32] {
        &self.end
    }
}
